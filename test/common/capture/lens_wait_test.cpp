#include "common/capture/lens_wait.h"

#include <gtest/gtest.h>

namespace deixis::capture {
namespace {

TEST(LensWait, HoldsPicturesBackForTwoSecondsOfTheirTime) {
  const Calibration calibration{CalibrationConfig{}};
  LensWait wait;
  EXPECT_TRUE(wait.Holds(calibration, {7'000'000}));
  EXPECT_TRUE(wait.Holds(calibration, {8'999'999}));
  EXPECT_FALSE(wait.Holds(calibration, {9'000'000}));
  EXPECT_FALSE(wait.Holds(calibration, {9'100'000}));
  EXPECT_EQ(wait.held_back(), 2);
}

TEST(LensWait, EndsWithTheLens) {
  Calibration calibration{CalibrationConfig{}};
  LensWait wait;
  EXPECT_TRUE(wait.Holds(calibration, {1}));
  calibration.UseOwn(geometry::GuessCalibration(64, 48, 1.0));
  EXPECT_FALSE(wait.Holds(calibration, {2}));
  EXPECT_EQ(wait.held_back(), 1);
}

TEST(LensWait, EndsWhenTimesDoNotGoOn) {
  const Calibration calibration{CalibrationConfig{}};
  LensWait wait;
  EXPECT_TRUE(wait.Holds(calibration, {1'000}));
  EXPECT_FALSE(wait.Holds(calibration, {1'000}));
}

}  // namespace
}  // namespace deixis::capture
