#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/body_model/body_model.h"

namespace deixis::pose_fitter {

/// Which arm of a body.
enum class ArmSide { kRight, kLeft };

/// The same body with this arm in places where arms are often lost from one another: hanging,
/// before the trunk, on the hip, at the camera, to the side, up, at the head, waving; and with the
/// forearm alone turned about the elbow. Empty when the model has no such arm.
std::vector<body_model::BodyPose> ArmPoses(const body_model::BodyModel& model,
                                           const body_model::BodyPose& pose, ArmSide side);

/// The same body with the middle of this hand at `hand_m` (in the pose's frame), or as near as the
/// arm reaches, and the elbow all around the line from shoulder to hand. Empty when the model has
/// no such arm.
std::vector<body_model::BodyPose> ReachingPoses(const body_model::BodyModel& model,
                                                const body_model::BodyPose& pose, ArmSide side,
                                                const Eigen::Vector3d& hand_m);

/// The same body with this elbow towards `elbow_m` (in the pose's frame) and the forearm in places
/// where it may be from there. Empty when the model has no such arm.
std::vector<body_model::BodyPose> ElbowPoses(const body_model::BodyModel& model,
                                             const body_model::BodyPose& pose, ArmSide side,
                                             const Eigen::Vector3d& elbow_m);

}  // namespace deixis::pose_fitter
