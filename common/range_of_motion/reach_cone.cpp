#include "common/range_of_motion/reach_cone.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace deixis::range_of_motion {
namespace {

constexpr double kTurn_rad = 2.0 * M_PI;

double AngleFromZ(const Eigen::Vector3d& direction) {
  return std::atan2(std::hypot(direction.x(), direction.y()), direction.z());
}

double AroundZ(const Eigen::Vector3d& direction) {
  return std::atan2(direction.y(), direction.x());
}

}  // namespace

ReachCone::ReachCone(const std::vector<Knot>& knots) {
  std::vector<std::size_t> order(knots.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&knots](std::size_t a, std::size_t b) {
    return AroundZ(knots[a].direction) < AroundZ(knots[b].direction);
  });
  for (const std::size_t i : order) {
    const Eigen::Vector3d& direction = knots[i].direction;
    if (std::hypot(direction.x(), direction.y()) < 1e-6) {
      throw std::invalid_argument("a knot lies at the rest direction or opposite to it");
    }
    around_rad_.push_back(AroundZ(direction));
    boundary_rad_.push_back(AngleFromZ(direction));
    motions_.push_back(knots[i].motion);
  }
  for (std::size_t i = 0; i < around_rad_.size(); ++i) {
    const bool is_last = i + 1 == around_rad_.size();
    const double next_rad = is_last ? around_rad_[0] + kTurn_rad : around_rad_[i + 1];
    if (next_rad - around_rad_[i] >= M_PI) {
      throw std::invalid_argument("neighbouring knots lie half a turn or more apart");
    }
  }
}

ReachCone::Place ReachCone::Find(const Eigen::Vector3d& direction) const {
  const double around_rad = AroundZ(direction);
  const auto above = std::upper_bound(around_rad_.begin(), around_rad_.end(), around_rad);
  const std::size_t count = around_rad_.size();
  const auto next = static_cast<std::size_t>(above - around_rad_.begin()) % count;
  const std::size_t last = (next + count - 1) % count;
  double gap_rad = around_rad_[next] - around_rad_[last];
  if (gap_rad <= 0.0) gap_rad += kTurn_rad;
  double from_last_rad = around_rad - around_rad_[last];
  if (from_last_rad < 0.0) from_last_rad += kTurn_rad;
  const double share = from_last_rad / gap_rad;
  return {AngleFromZ(direction),
          boundary_rad_[last] + share * (boundary_rad_[next] - boundary_rad_[last]),
          static_cast<int>(share < 0.5 ? last : next)};
}

}  // namespace deixis::range_of_motion
