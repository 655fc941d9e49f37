#include "common/range_of_motion/bound.h"

#include <algorithm>
#include <cmath>

#include "common/config/config.h"

namespace deixis::range_of_motion {
namespace {

constexpr double kRadiansPerDegree = M_PI / 180.0;
constexpr double kBent_rad = M_PI / 2.0;

Reach ReachOf(const anatomy::JointLimit& row, double beyond_rad) {
  return {row.low_deg * kRadiansPerDegree, row.high_deg * kRadiansPerDegree + beyond_rad};
}

Reach Between(const Reach& a, const Reach& b, double share) {
  return {a.low_rad + share * (b.low_rad - a.low_rad),
          a.high_rad + share * (b.high_rad - a.high_rad)};
}

Reach Wider(const Reach& a, const Reach& b) {
  return {std::max(a.low_rad, b.low_rad), std::max(a.high_rad, b.high_rad)};
}

}  // namespace

Reach Bound::At(double flexion_rad, Load load) const {
  const Reach bent = Between(straight, flexed, std::clamp(flexion_rad / kBent_rad, 0.0, 1.0));
  if (!hanging || load == Load::kLoaded) return bent;
  return load == Load::kFree ? *hanging : Wider(bent, *hanging);
}

double Bound::Outermost_rad() const {
  return std::max({straight.high_rad, flexed.high_rad, hanging ? hanging->high_rad : 0.0});
}

Bound BoundOf(const anatomy::JointLimits& limits, const std::string& joint,
              const std::string& motion, double beyond_rad) {
  std::optional<Reach> straight, flexed, hanging;
  for (const anatomy::JointLimit& row : limits.rows()) {
    if (row.joint != joint || row.motion != motion) continue;
    const Reach reach = ReachOf(row, beyond_rad);
    if (row.posture == anatomy::Posture::kFlexedBy90) {
      flexed = reach;
    } else if (row.posture == anatomy::Posture::kHanging) {
      hanging = reach;
    } else {
      straight = reach;
    }
  }
  if (!straight && !flexed) {
    throw config::ConfigError("joint '" + joint +
                              "': joint_limits.yaml has no row of the motion '" + motion + "'");
  }
  const Reach none{0.0, beyond_rad};
  return {motion, straight.value_or(none), flexed.value_or(straight.value_or(none)), hanging};
}

}  // namespace deixis::range_of_motion
