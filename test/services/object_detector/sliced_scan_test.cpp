#include "services/object_detector/core/sliced_scan.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "test/services/object_detector/clip.h"

namespace deixis::object_detector {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kPeriod_us = 66'667;

class SlicedScanTest : public testing::Test {
 protected:
  /// Numbers of the calls that answered with the face, when the same picture is shown over and
  /// over.
  std::vector<int> CallsThatShowTheFace(const ScanConfig& config, int calls, Urgency urgency) {
    GreyPicture picture{{0}, Grey(ClipPictures(1).at(0))};
    SlicedScan scan(config, cascade_.window());
    std::vector<int> found;
    for (int call = 0; call < calls; ++call) {
      picture.time.microseconds += kPeriod_us;
      for (const CascadeHit& hit : scan.Next(picture, cascade_, urgency)) {
        const bool is_face = scene::DistanceTo(hit.box, {kNose.x, kNose.y}) == 0.0;
        if (is_face && (found.empty() || found.back() != call)) found.push_back(call);
      }
    }
    return found;
  }
  Cascade cascade_{"haarcascade_frontalface_alt2.xml", {"/usr/share/opencv4/haarcascades"}};
};

TEST_F(SlicedScanTest, LooksThroughTheWholePictureAgainAndAgain) {
  // A round takes 22 or 23 pictures. The face answers at two or three sizes of a round, not always.
  const std::vector<int> found = CallsThatShowTheFace({}, 69, Urgency::kForMore);
  const auto shows_between = [&found](int first, int last) {
    return std::any_of(found.begin(), found.end(),
                       [=](int call) { return call >= first && call <= last; });
  };
  EXPECT_TRUE(shows_between(0, 2));
  EXPECT_TRUE(shows_between(3, 26));
  EXPECT_TRUE(shows_between(27, 68));
  EXPECT_LT(found.size(), 25u);
}

TEST_F(SlicedScanTest, LooksThroughTheFirstPictureAtOnceWhenAsked) {
  ScanConfig config;
  config.pictures_at_start = 1;
  EXPECT_EQ(CallsThatShowTheFace(config, 1, Urgency::kForAny), std::vector<int>{0});
}

TEST_F(SlicedScanTest, HurriesWhileThereIsNothing) {
  const std::size_t at_ease = CallsThatShowTheFace({}, 60, Urgency::kForMore).size();
  EXPECT_GT(CallsThatShowTheFace({}, 60, Urgency::kForAny).size(), at_ease);
}

TEST_F(SlicedScanTest, PlansAnewForAnotherSizeOfPicture) {
  SlicedScan scan({}, cascade_.window());
  for (const cv::Size size : {cv::Size(640, 480), cv::Size(1920, 1080), cv::Size(160, 120),
                              cv::Size(21, 300), cv::Size(5, 5)}) {
    const GreyPicture picture{{0}, cv::Mat(size, CV_8UC1, cv::Scalar(100))};
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(scan.Next(picture, cascade_, Urgency::kForAny).empty());
  }
}

TEST(ScanConfig, RefusesARoundThatTakesNoTime) {
  ScanConfig config;
  config.round_s = 0.0;
  config::Faults faults;
  config.Check(faults);
  EXPECT_THAT([&faults] { faults.ThrowIfAny(); },
              testing::ThrowsMessage<config::ConfigError>(HasSubstr("cascades.scan.round_s")));
}

}  // namespace
}  // namespace deixis::object_detector
