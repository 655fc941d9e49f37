#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/body_model/kinematics.h"
#include "common/range_of_motion/range_of_motion.h"
#include "services/anthropometer/core/projection.h"

namespace deixis::anthropometer {

/// How far a joint gets to one side in a plane.
struct PlaneBound {
  double angle_rad = 0.0;  ///< From the neutral direction, 0..pi.
  std::string motion;      ///< Key in joint_limits.yaml of what ends there.
};

/// Where the limb beyond a joint may point at, in the plane of a view through the joint.
struct PlaneReach {
  const range_of_motion::ModelJoint* joint = nullptr;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< In the frame of the base limb.
  double length_m = 0.0;                               ///< Of the limb.
  double neutral_rad = 0.0;  ///< Its neutral direction: 0 = right in the picture, pi/2 = up.
  PlaneBound clockwise;      ///< From neutral.
  PlaneBound anticlockwise;
};

/// The reaches of all joints that move in the view's plane, the limbs above them as they are in
/// `kinematics`, whose base limb stands in the origin.
std::vector<PlaneReach> ReachesIn(View view, const body_model::Kinematics& kinematics,
                                  const range_of_motion::RangeOfMotion& range);

}  // namespace deixis::anthropometer
