#include "services/camera_driver/core/sources/capture.h"

#include <gtest/gtest.h>

namespace deixis::camera_driver {
namespace {

constexpr std::int64_t kWall_us = 1'700'000'000'000'000;
constexpr std::int64_t kMonotonic_us = 5'000'000'000;

Clocks FixedClocks() {
  return {[] { return Timestamp{kWall_us}; }, [] { return Timestamp{kMonotonic_us}; }};
}

TEST(CaptureTime, MapsTheDriversMonotonicStampOntoTheWallClock) {
  const double taken_40ms_ago = 1e-3 * (kMonotonic_us - 40'000);
  EXPECT_EQ(CaptureTime(taken_40ms_ago, FixedClocks()).microseconds, kWall_us - 40'000);
}

TEST(CaptureTime, TakesADriversWallClockStampAsItIs) {
  const double taken_40ms_ago = 1e-3 * (kWall_us - 40'000);
  EXPECT_NEAR(static_cast<double>(CaptureTime(taken_40ms_ago, FixedClocks()).microseconds),
              static_cast<double>(kWall_us - 40'000), 1.0);
}

TEST(CaptureTime, IsNowWithoutAStamp) {
  EXPECT_EQ(CaptureTime(0.0, FixedClocks()).microseconds, kWall_us);
  EXPECT_EQ(CaptureTime(-1.0, FixedClocks()).microseconds, kWall_us);
}

TEST(CaptureTime, IsNowWhenTheStampIsOfAnUnknownClock) {
  EXPECT_EQ(CaptureTime(123.0, FixedClocks()).microseconds, kWall_us);
  EXPECT_EQ(CaptureTime(1e-3 * (kMonotonic_us + 90'000), FixedClocks()).microseconds, kWall_us);
}

TEST(DeviceCapture, GivesNoReaderForADeviceThatIsNotThere) {
  SourceConfig config;
  config.path = "/dev/video_that_is_not_there";
  EXPECT_FALSE(DeviceCapture(config, FixedClocks()).open());
}

}  // namespace
}  // namespace deixis::camera_driver
