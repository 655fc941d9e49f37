#include "services/gesture_recogniser/core/context.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <limits>

#include "services/gesture_recogniser/core/motion_features.h"

namespace deixis::gesture_recogniser {
namespace {

/// Where a target is seen from the hand.
struct Bearing {
  double distance_m = 0.0;
  double angle_rad = 0.0;  ///< Relative to the hand's direction.
};

Bearing BearingOf(const Target& target, const Eigen::Vector2d& hand_m,
                  const Eigen::Vector2d& direction) {
  const Eigen::Vector2d way = scene::Centre(target.box_m) - hand_m;
  const double heading = std::atan2(direction.y(), direction.x());
  return {scene::DistanceTo(target.box_m, hand_m),
          WrapAngle(std::atan2(way.y(), way.x()) - heading)};
}

bool IsInside(const ModelPoint& point, const Bearing& bearing, ContextUse use) {
  if (bearing.distance_m > point.context_radius_m) return false;
  if (use == ContextUse::kDistance) return true;
  return bearing.angle_rad >= point.context_start_rad && bearing.angle_rad <= point.context_end_rad;
}

}  // namespace

void ContextAreas::Update(const GestureModel& model, ContextUse use, const Eigen::Vector2d& hand_m,
                          const Eigen::Vector2d& direction, const std::vector<Target>& targets) {
  inside_.assign(model.points.size(), 0);
  has_area_.assign(model.points.size(), false);
  if (use == ContextUse::kNone || model.context == ContextNeed::kNone) return;
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    has_area_[i] = model.points[i].context_radius_m > 0.0;
  }
  const std::size_t count = std::min<std::size_t>(targets.size(), kMostTargets);
  for (std::size_t k = 0; k < count; ++k) {
    const Bearing bearing = BearingOf(targets[k], hand_m, direction);
    for (std::size_t i = 0; i < model.points.size(); ++i) {
      if (has_area_[i] && IsInside(model.points[i], bearing, use)) inside_[i] |= TargetSet{1} << k;
    }
  }
}

Area AreaOf(const ModelPoint& point, const Eigen::Vector2d& hand_m,
            const Eigen::Vector2d& direction) {
  const double heading = std::atan2(direction.y(), direction.x());
  return {hand_m, point.context_radius_m, heading + point.context_start_rad,
          heading + point.context_end_rad};
}

int Count(TargetSet set) { return static_cast<int>(std::bitset<kMostTargets>(set).count()); }

int Pick(TargetSet set, int rank) {
  int index = 0;
  for (; set != 0; ++index, set >>= 1U) {
    if ((set & 1U) != 0 && rank-- == 0) break;
  }
  return index;
}

}  // namespace deixis::gesture_recogniser
