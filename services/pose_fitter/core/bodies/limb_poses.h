#pragma once
#include <Eigen/Core>
#include <vector>

#include "services/pose_fitter/core/bodies/limb_chain.h"

namespace deixis::pose_fitter {

/// The same body with this arm or leg in places where such are often lost from one another. Arms:
/// hanging, before the trunk, on the hip, forward, to the side, up, at the head, waving, and with
/// the forearm alone turned about the elbow. Legs: standing, stepping, seated, kneeling, squatting,
/// in an upright person's sense of down, whatever the trunk does. `up`: away from the floor, in the
/// pose's frame, of length 1.
std::vector<body_model::BodyPose> UsualPoses(const body_model::BodyModel& model,
                                             const ChainLimbs& limbs,
                                             const body_model::BodyPose& pose,
                                             const Eigen::Vector3d& up);

/// The same body with the middle of this hand, or this ankle, at `end_m` (in the pose's frame), or
/// as near as it reaches, and elbow or knee all around the line to it.
std::vector<body_model::BodyPose> ReachingPoses(const body_model::BodyModel& model,
                                                const ChainLimbs& limbs,
                                                const body_model::BodyPose& pose,
                                                const Eigen::Vector3d& end_m);

/// The same body with this elbow towards `elbow_m` (in the pose's frame) and the forearm in places
/// where it may be from there.
std::vector<body_model::BodyPose> ElbowPoses(const body_model::BodyModel& model,
                                             const ChainLimbs& limbs,
                                             const body_model::BodyPose& pose,
                                             const Eigen::Vector3d& elbow_m);

}  // namespace deixis::pose_fitter
