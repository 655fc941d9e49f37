#pragma once
#include <opencv2/core/mat.hpp>

#include "common/body_model/body_model.h"

namespace deixis::anthropometer {

/// From where a body is looked at.
enum class View { kFront, kSide };

/// The body as the outlines of its limbs, CV_8UC3, `height_px` high: the nearer limbs over the
/// farther ones, joints as dots, its right side warmer than its left. The picture shows `span_m` of
/// the world in both directions around the middle of the body.
cv::Mat Draw(const body_model::BodyModel& model, const body_model::BodyPose& pose, View view,
             int height_px, double span_m);

/// Front and side view beside each other.
cv::Mat DrawFrontAndSide(const body_model::BodyModel& model, const body_model::BodyPose& pose,
                         int height_px);

}  // namespace deixis::anthropometer
