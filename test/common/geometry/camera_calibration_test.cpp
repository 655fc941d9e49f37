#include "common/geometry/camera_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "common/geometry/lens_limits.h"

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

TEST(CameraCalibration, GuessIsALensWhateverTheAngle) {
  EXPECT_TRUE(IsLens(GuessCalibration(640, 480, 1e-300)));
  EXPECT_TRUE(IsLens(GuessCalibration(640, 480, M_PI - 1e-9)));
}

TEST(LensLimits, TakeALensAndRefuseItBrokenOneWay) {
  const CameraCalibration good = GuessCalibration(640, 480, 1.0);
  EXPECT_TRUE(IsLens(good));
  for (const double focal_px : {0.999, 1.1e6, -500.0, std::nan(""), HUGE_VAL}) {
    CameraCalibration lens = good;
    lens.focal_px.y() = focal_px;
    EXPECT_FALSE(IsLens(lens)) << focal_px;
  }
  for (const double centre_px : {1.1e6, -1.1e6, std::nan("")}) {
    CameraCalibration lens = good;
    lens.principal_point_px.x() = centre_px;
    EXPECT_FALSE(IsLens(lens)) << centre_px;
  }
  CameraCalibration turned = good;
  turned.rectification(2, 2) = -1.0;
  EXPECT_FALSE(IsLens(turned));
}

TEST(LensLimits, TakeAsManyCoefficientsAsTheModelHasAndNoneOfAnAbsurdSize) {
  EXPECT_TRUE(IsDistortion(DistortionModel::kNone, {}));
  EXPECT_TRUE(IsDistortion(DistortionModel::kPlumbBob, {0.1, 0.2, 0.0, 0.0, 1e6}));
  EXPECT_FALSE(IsDistortion(DistortionModel::kPlumbBob, {0.1, 0.2}));
  EXPECT_FALSE(IsDistortion(DistortionModel::kFisheye, {0.1, 0.2, 0.0, -1.1e6}));
  EXPECT_FALSE(IsDistortion(DistortionModel::kFisheye, {0.1, 0.2, 0.0, std::nan("")}));
}

}  // namespace
}  // namespace deixis::geometry
