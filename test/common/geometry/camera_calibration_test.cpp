#include "common/geometry/camera_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace deixis::geometry {
namespace {

TEST(CameraCalibration, GuessSeesTheWholeFieldOfView) {
  const CameraCalibration guess = GuessCalibration(640, 480, M_PI / 3.0);
  EXPECT_FALSE(guess.is_calibrated);
  const Eigen::Vector2d edge = Project(guess, {std::tan(M_PI / 6.0), 0.0, 1.0});
  EXPECT_NEAR(edge.x(), 639.5, 1e-9);  // right border of the last pixel
  EXPECT_NEAR(edge.y(), 239.5, 1e-9);
}

TEST(CameraCalibration, GuessRejectsSizesAndAnglesThatNoCameraHas) {
  EXPECT_THROW(GuessCalibration(0, 480, 1.0), std::invalid_argument);
  EXPECT_THROW(GuessCalibration(640, 480, 0.0), std::invalid_argument);
  EXPECT_THROW(GuessCalibration(640, 480, M_PI), std::invalid_argument);
  EXPECT_THROW(GuessCalibration(640, 480, std::nan("")), std::invalid_argument);
}

TEST(CameraCalibration, ProjectAppliesRadialDistortion) {
  CameraCalibration camera = GuessCalibration(640, 480, 1.0);
  camera.distortion_model = DistortionModel::kPlumbBob;
  camera.distortion = {0.1, 0.0, 0.0, 0.0, 0.0};
  const double x = 0.3;
  const double expected =
      camera.focal_px.x() * x * (1.0 + 0.1 * x * x) + camera.principal_point_px.x();
  EXPECT_NEAR(Project(camera, {x, 0.0, 1.0}).x(), expected, 1e-9);
}

TEST(CameraCalibration, ProjectKnowsFisheyeLenses) {
  CameraCalibration camera = GuessCalibration(640, 480, 1.0);
  camera.distortion_model = DistortionModel::kFisheye;
  camera.distortion = {0.0, 0.0, 0.0, 0.0};
  const double expected = camera.focal_px.x() * std::atan(0.5) + camera.principal_point_px.x();
  EXPECT_NEAR(Project(camera, {0.5, 0.0, 1.0}).x(), expected, 1e-9);
}

}  // namespace
}  // namespace deixis::geometry
