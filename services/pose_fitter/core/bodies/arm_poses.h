#pragma once
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

}  // namespace deixis::pose_fitter
