#pragma once
#include <optional>

#include "common/body_model/body_model.h"
#include "test/services/pose_fitter/synthetic_room.h"

namespace deixis::pose_fitter::test {

/// The clothed body of somebody of that stature, sex not known.
body_model::BodyModel ClothedBody(double stature_m = 1.75);

/// Stands at (x_m, y_m) of the room, soles on its floor, facing the camera, upper arms
/// `abduction_rad` away from the trunk; in the camera's optical frame.
body_model::BodyPose StandingIn(const Room& room, const body_model::BodyModel& body, double x_m,
                                double y_m, double abduction_rad = 0.15);

/// Draws the body, with the noise of the picture's camera, wherever it is nearer than what is seen.
/// Each ray walks to the nearest surface by the exact distance to it (sphere tracing, Hart 1996).
void Draw(const body_model::BodyModel& body, const body_model::BodyPose& pose, int owner,
          Picture& picture);

/// Where the ray of a pixel, (x, y, 1), meets the limb, as depth in metres; nothing = it passes by.
std::optional<double> DepthOn(const geometry::DegenerateCylinder& shape,
                              const Eigen::Isometry3d& camera_from_limb,
                              const Eigen::Vector3d& ray);

/// What goes out on STEREO_CALIBRATION for the picture.
geometry::StereoCalibration CalibrationOf(const Picture& picture);

}  // namespace deixis::pose_fitter::test
