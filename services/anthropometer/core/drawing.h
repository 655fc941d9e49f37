#pragma once
#include <opencv2/core/mat.hpp>

#include "common/body_model/kinematics.h"
#include "services/anthropometer/core/projection.h"

namespace deixis::anthropometer {

/// The body as the outlines of its limbs, CV_8UC3, `height_px` high: the nearer limbs over the
/// farther ones, joints as dots, its right side warmer than its left. The picture shows `span_m` of
/// the world in both directions around the middle of the body.
cv::Mat Draw(const body_model::BodyModel& model, const body_model::BodyPose& pose, View view,
             int height_px, double span_m);

/// Front and side view beside each other.
cv::Mat DrawFrontAndSide(const body_model::BodyModel& model, const body_model::BodyPose& pose,
                         int height_px);

/// How Draw shows a body, which stands in `kinematics` with its base limb's joint in the origin.
Projection ProjectionOf(const body_model::Kinematics& kinematics, View view, int height_px,
                        double span_m);

/// The span that shows all of a body, with a margin.
double SpanOf(const body_model::Kinematics& kinematics);

}  // namespace deixis::anthropometer
