#pragma once
#include <optional>
#include <string>

#include "common/anatomy/joint_limits.h"

namespace deixis::range_of_motion {

/// Whether weight is on the limb: the source has other limits for a standing and a hanging foot.
enum class Load {
  kUnknown,  ///< The wider limit holds.
  kLoaded,
  kFree
};

/// How far people get, radians: the source gives some limits as ranges.
struct Reach {
  double low_rad = 0.0;   ///< Nearly everybody.
  double high_rad = 0.0;  ///< Nobody gets farther; the limit.
};

/// How far a joint moves in one way, as it depends on the posture.
struct Bound {
  std::string motion;            ///< Key in joint_limits.yaml.
  Reach straight;                ///< The joint itself not bent.
  Reach flexed;                  ///< Bent by 90 degrees and more; between both linear.
  std::optional<Reach> hanging;  ///< Without load.

  /// With the joint itself bent by `flexion_rad`.
  Reach At(double flexion_rad, Load load) const;
  /// The largest of all postures, radians.
  double Outermost_rad() const;
};

/// From the rows of a joint and motion, each widened by `beyond_rad`. A motion that the source has
/// only of a bent joint is none of a straight one. Throws ConfigError when there is no row.
Bound BoundOf(const anatomy::JointLimits& limits, const std::string& joint,
              const std::string& motion, double beyond_rad);

}  // namespace deixis::range_of_motion
