#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "common/body_model/body_model.h"
#include "common/range_of_motion/range_plan.h"

namespace deixis::range_of_motion {

/// How fast a joint turns, its limbs together: the length of the rotation vector between two of its
/// orientations, over the time between them.
struct JointSpeed {
  std::string joint;  ///< Key in joint_limits.yaml.
  double speed_deg_per_s = 0.0;
  double acceleration_deg_per_s2 = 0.0;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("joint", joint);
    v("speed_deg_per_s", speed_deg_per_s);
    v("acceleration_deg_per_s2", acceleration_deg_per_s2);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// A file of config/kinematics: limits of speed and acceleration, and what they rest on.
struct SpeedLimits {
  std::string derived_from;
  std::string certainty;
  std::vector<JointSpeed> joints;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("derived_from", derived_from);
    v("certainty", certainty);
    v("joints", joints);
  }
  void Validate() const;                                   ///< Throws FaultsFound.
  const JointSpeed* Find(const std::string& joint) const;  ///< nullptr = no limit known.
};

/// Reads config/kinematics/joint_speeds.yaml. Throws ConfigError naming file, line and key.
SpeedLimits LoadSpeedLimits(const std::filesystem::path& path);

/// The model, each degree of freedom with the limits of the joint that its limb belongs to; others
/// keep theirs. Throws ConfigError for a joint that the plan lacks.
body_model::BodyModel WithSpeedLimits(const body_model::BodyModel& model, const RangePlan& plan,
                                      const SpeedLimits& limits);

}  // namespace deixis::range_of_motion
