#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/body_model/tracked_body.h"

namespace deixis::pose_fitter {

/// Where a person may be whose head ends at `head_top_m` (on the surface that is seen, in the
/// camera's optical frame): standing and, where that is not as high as a standing one or the floor
/// is not known, seated; each looking in several directions about the vertical, arms hanging.
std::vector<body_model::BodyPose> StartPoses(const body_model::BodyModel& model,
                                             const Eigen::Vector3d& head_top_m,
                                             const std::optional<body_model::Floor>& floor);

}  // namespace deixis::pose_fitter
