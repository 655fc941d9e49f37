#include "common/capture/capture.h"

#include <gmock/gmock.h>

#include <opencv2/videoio.hpp>

#include "common/capture/sources.h"

namespace deixis::capture {
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

/// A camera whose backend throws where the test says so.
class ThrowingCamera final : public cv::VideoCapture {
 public:
  enum class At { kNever, kGrab, kRetrieve };
  explicit ThrowingCamera(At at) : at_(at) {}
  bool grab() override {
    if (at_ == At::kGrab) CV_Error(cv::Error::StsError, "unplugged");
    return true;
  }
  bool retrieve(cv::OutputArray image, int) override {
    if (at_ == At::kRetrieve) CV_Error(cv::Error::StsError, "not decodable");
    cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(1)).copyTo(image);
    return true;
  }

 private:
  At at_;
};

std::optional<LivePicture> ReadFrom(ThrowingCamera::At at) {
  return ReaderOf(std::make_shared<ThrowingCamera>(at), FixedClocks().wall)();
}

TEST(ReaderOf, ReadsAPictureWithItsTime) {
  const auto picture = ReadFrom(ThrowingCamera::At::kNever);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->time.microseconds, kWall_us);
  EXPECT_EQ(picture->bgr.cols, 4);
}

TEST(ReaderOf, TakesAnExceptionWhenGrabbingForALostCamera) {
  EXPECT_FALSE(ReadFrom(ThrowingCamera::At::kGrab));
}

TEST(ReaderOf, TakesAnExceptionWhenDecodingForAPictureThatIsCorrupt) {
  const auto picture = ReadFrom(ThrowingCamera::At::kRetrieve);
  ASSERT_TRUE(picture);
  EXPECT_TRUE(picture->bgr.empty());
}

TEST(DeviceCapture, GivesNoReaderForADeviceThatIsNotThere) {
  SourceConfig config;
  config.path = "/dev/video_that_is_not_there";
  EXPECT_FALSE(DeviceCapture(config, FixedClocks()).open());
}

TEST(MakeSource, RefusesADimosRobotWhosePicturesComeOverTheBus) {
  SourceConfig config;
  config.kind = SourceKind::kDimos;
  config.key = "source.left";
  EXPECT_THAT([&] { MakeSource(config, FixedClocks()); },
              testing::ThrowsMessage<config::ConfigError>(testing::HasSubstr(
                  "source.left.kind is dimos, whose pictures come over the bus")));
}

}  // namespace
}  // namespace deixis::capture
