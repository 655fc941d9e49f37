#include "common/geometry/camera_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace deixis::geometry {
namespace {

TEST(CameraCalibration, GuessSeesTheWholeFieldOfView) {
  const CameraCalibration guess = GuessCalibration(640, 480, M_PI / 3.0);
  EXPECT_FALSE(guess.is_calibrated);
  const double right_edge_px =
      guess.focal_px.x() * std::tan(M_PI / 6.0) + guess.principal_point_px.x();
  EXPECT_NEAR(right_edge_px, 639.5, 1e-9);  // right border of the last pixel
  EXPECT_EQ(guess.focal_px.x(), guess.focal_px.y());
  EXPECT_NEAR(guess.principal_point_px.y(), 239.5, 1e-9);
}

TEST(CameraCalibration, GuessRejectsSizesAndAnglesThatNoCameraHas) {
  EXPECT_THROW(GuessCalibration(0, 480, 1.0), std::invalid_argument);
  EXPECT_THROW(GuessCalibration(640, 480, 0.0), std::invalid_argument);
  EXPECT_THROW(GuessCalibration(640, 480, M_PI), std::invalid_argument);
  EXPECT_THROW(GuessCalibration(640, 480, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace deixis::geometry
