#include "services/hand_tracker/core/skin_regions.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace deixis::hand_tracker {
namespace {

constexpr HysteresisThresholds kThresholds{100, 200};

cv::Mat Empty() { return cv::Mat::zeros(60, 80, CV_8UC1); }

TEST(FindRegions, FindsNothingInAnEmptyPicture) {
  EXPECT_TRUE(FindRegions(Empty(), kThresholds, 1).empty());
}

TEST(FindRegions, GivesAreaAndBounds) {
  cv::Mat evidence = Empty();
  evidence(cv::Rect(10, 20, 7, 5)).setTo(255);
  const auto regions = FindRegions(evidence, kThresholds, 1);
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_EQ(regions[0].area_px, 35);
  EXPECT_EQ(regions[0].left, 10);
  EXPECT_EQ(regions[0].right, 16);
  EXPECT_EQ(regions[0].top, 20);
  EXPECT_EQ(regions[0].bottom, 24);
}

TEST(FindRegions, WeakPixelsBelongOnlyToRegionsWithAStrongOne) {
  cv::Mat evidence = Empty();
  evidence(cv::Rect(5, 5, 10, 10)).setTo(150);
  evidence(cv::Rect(40, 5, 10, 10)).setTo(150);
  evidence.at<std::uint8_t>(8, 45) = 220;
  const auto regions = FindRegions(evidence, kThresholds, 1);
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_EQ(regions[0].left, 40);
  EXPECT_EQ(regions[0].area_px, 100);
}

TEST(FindRegions, JoinsWhatTouchesAtACorner) {
  cv::Mat evidence = Empty();
  evidence(cv::Rect(10, 10, 5, 5)).setTo(255);
  evidence(cv::Rect(15, 15, 5, 5)).setTo(255);
  EXPECT_EQ(FindRegions(evidence, kThresholds, 1).size(), 1U);
}

TEST(FindRegions, LeavesSmallOnesOut) {
  cv::Mat evidence = Empty();
  evidence(cv::Rect(10, 10, 2, 2)).setTo(255);
  EXPECT_TRUE(FindRegions(evidence, kThresholds, 5).empty());
}

TEST(FindRegions, AgreesWithOpenCvOnRandomPictures) {
  cv::RNG random(3);
  for (int i = 0; i < 20; ++i) {
    cv::Mat noise(60, 80, CV_8UC1);
    random.fill(noise, cv::RNG::UNIFORM, 0, 256);
    cv::Mat blurred;
    cv::blur(noise, blurred, {3, 3});
    const cv::Mat mask = blurred >= 130;
    cv::Mat labels, stats, centres;
    const int n = cv::connectedComponentsWithStats(mask, labels, stats, centres, 8);
    const auto regions = FindRegions(blurred, {130, 130}, 1);
    ASSERT_EQ(static_cast<int>(regions.size()), n - 1);
    int area = 0;
    for (const SkinRegion& region : regions) area += region.area_px;
    EXPECT_EQ(area, cv::countNonZero(mask));
  }
}

}  // namespace
}  // namespace deixis::hand_tracker
