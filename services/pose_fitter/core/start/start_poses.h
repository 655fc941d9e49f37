#pragma once
#include <vector>

#include "common/body_model/tracked_body.h"
#include "services/pose_fitter/core/people/people_finder.h"

namespace deixis::pose_fitter {

/// Where a person that was found may be: standing and, where it is not as high as a standing one,
/// seated, each looking in several directions about the vertical; arms hanging.
std::vector<body_model::BodyPose> StartPoses(const body_model::BodyModel& model,
                                             const PersonRegion& region,
                                             const std::optional<body_model::Floor>& floor);

}  // namespace deixis::pose_fitter
