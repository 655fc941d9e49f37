#include "services/object_detector/core/sliced_scan.h"

#include <gmock/gmock.h>

#include "test/services/object_detector/clip.h"

namespace deixis::object_detector {
namespace {

using testing::HasSubstr;

class SlicedScanTest : public testing::Test {
 protected:
  /// Numbers of the calls that answered with the face, when the same picture is shown over and
  /// over.
  std::vector<int> CallsThatShowTheFace(const ScanConfig& config, int calls) {
    const cv::Mat grey = Grey(ClipPictures(1).at(0));
    SlicedScan scan(config, cascade_.window());
    std::vector<int> found;
    for (int call = 0; call < calls; ++call) {
      for (const CascadeHit& hit : scan.Next(grey, cascade_, Urgency::kForMore)) {
        const bool is_face = scene::DistanceTo(hit.box, {kNose.x, kNose.y}) == 0.0;
        if (is_face && (found.empty() || found.back() != call)) found.push_back(call);
      }
    }
    return found;
  }
  Cascade cascade_{"haarcascade_frontalface_alt2.xml", {"/usr/share/opencv4/haarcascades"}};
};

TEST_F(SlicedScanTest, LooksThroughTheWholePictureAgainAndAgain) {
  ScanConfig config;
  config.windows_at_start = config.windows_per_image;
  const std::vector<int> found = CallsThatShowTheFace(config, 60);
  ASSERT_GE(found.size(), 2u);  // At least once in each of two rounds of about 20 calls.
  EXPECT_LT(found.front(), 25);
  EXPECT_GT(found.back(), 25);
  EXPECT_LT(found.size(), 30u);  // And not in every call: it is a slice that is looked at.
}

TEST_F(SlicedScanTest, HurriesAtTheStart) {
  ScanConfig config;
  config.windows_at_start = 1'000'000;
  EXPECT_EQ(CallsThatShowTheFace(config, 1), std::vector<int>{0});
}

TEST_F(SlicedScanTest, PlansAnewForAnotherSizeOfPicture) {
  SlicedScan scan({}, cascade_.window());
  for (const cv::Size size : {cv::Size(640, 480), cv::Size(1920, 1080), cv::Size(160, 120),
                              cv::Size(21, 300), cv::Size(5, 5)}) {
    const cv::Mat grey(size, CV_8UC1, cv::Scalar(100));
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(scan.Next(grey, cascade_, Urgency::kForAny).empty());
  }
}

TEST(ScanConfig, RefusesABudgetThatNoSliceFitsIn) {
  ScanConfig config;
  config.windows_per_image = 10;
  config::Faults faults;
  config.Check(faults);
  EXPECT_THAT([&faults] { faults.ThrowIfAny(); },
              testing::ThrowsMessage<config::ConfigError>(HasSubstr("windows_per_image")));
}

}  // namespace
}  // namespace deixis::object_detector
