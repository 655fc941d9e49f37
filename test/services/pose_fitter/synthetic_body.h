#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>

#include "common/body_model/body_model.h"
#include "services/pose_fitter/core/bodies/person_body.h"
#include "services/pose_fitter/core/depth/depth_view.h"
#include "services/pose_fitter/core/fitting/body_points.h"

namespace deixis::pose_fitter::test {

/// By a plan of config/body_models, named without its folder and ending.
BodyMaker MakerOf(const std::string& plan);

/// Somebody 1.75 m tall by such a plan.
body_model::BodyModel BodyOf(const std::string& plan);

/// Upright, 2.5 m before the camera and facing it, one arm raised forward and one to the side, both
/// bent; in the camera's optical frame.
body_model::BodyPose Gesturing(const body_model::BodyModel& model);

/// Another pose, whose joints are so far off on average; of the same seed the same.
body_model::BodyPose Disturbed(const body_model::BodyModel& model, const body_model::BodyPose& pose,
                               double mean_error_m, std::uint32_t seed = 1);

/// Mean distance of all limbs' ends in two poses.
double JointError_m(const body_model::BodyModel& model, const body_model::BodyPose& one,
                    const body_model::BodyPose& other);

/// What a depth camera sees of the body alone.
struct BodyPicture {
  DepthCamera camera;
  cv::Mat depth_mm;  ///< CV_16UC1.
};

/// 50 degrees wide, 4:3; `noise_m` along the optical axis, one sigma.
BodyPicture Look(const body_model::BodyModel& model, const body_model::BodyPose& pose, int width_px,
                 double noise_m = 0.0);

/// All points of a picture, by tiles of 8 x 8 pixels.
BodyPoints PointsOf(const BodyPicture& picture);

}  // namespace deixis::pose_fitter::test
