#include "services/stereo_driver/core/matching/depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "services/stereo_driver/core/matching/disparity.h"

namespace deixis::stereo_driver {
namespace {

const DepthGeometry kGeometry = {500.0, 0.12, 0.5, 10.0};
constexpr int kSearched = 128;

int DepthOf(int sixteenths) {
  const cv::Mat disparity(1, 1, CV_16SC1, cv::Scalar(sixteenths));
  cv::Mat depth_mm;
  DepthConverter(kGeometry, kSearched).Convert(disparity, depth_mm);
  return depth_mm.at<std::uint16_t>(0, 0);
}

TEST(DepthConverter, FollowsTheFormulaRoundedToTheNearestMillimetre) {
  EXPECT_EQ(DepthOf(30 * 16), 2000);
  for (int sixteenths = 97; sixteenths <= 1920; ++sixteenths) {
    EXPECT_EQ(DepthOf(sixteenths), std::lround(500.0 * 120.0 * 16.0 / sixteenths));
  }
}

TEST(DepthConverter, InvalidAndOutOfRangeAreZero) {
  EXPECT_EQ(DepthOf(kNoDisparity), 0);
  EXPECT_EQ(DepthOf(0), 0);
  EXPECT_EQ(DepthOf(-5), 0);
  EXPECT_EQ(DepthOf(96), 10000);
  EXPECT_EQ(DepthOf(95), 0);
  EXPECT_EQ(DepthOf(1920), 500);
  EXPECT_EQ(DepthOf(1921), 0);
  EXPECT_EQ(DepthOf(32767), 0);
}

/// The depth of the one pixel that four disparities in px make; 0 = invalid.
int HalvedDepthOf(double a, double b, double c, double d) {
  cv::Mat disparity(2, 2, CV_16SC1);
  int i = 0;
  for (const double px : {a, b, c, d}) {
    disparity.at<std::int16_t>(i / 2, i % 2) =
        static_cast<std::int16_t>(px > 0.0 ? std::lround(px * 16.0) : kNoDisparity);
    ++i;
  }
  cv::Mat depth_mm;
  DepthConverter(kGeometry, kSearched).ConvertHalved(disparity, depth_mm);
  EXPECT_EQ(depth_mm.size(), cv::Size(1, 1));
  return depth_mm.at<std::uint16_t>(0, 0);
}

TEST(DepthConverter, HalvingAveragesOneSurface) {
  EXPECT_EQ(HalvedDepthOf(30.0, 30.0, 30.0, 30.0), 2000);
  EXPECT_EQ(HalvedDepthOf(29.75, 30.25, 30.0, 30.0), 2000);
}

TEST(DepthConverter, HalvingMakesUpNoDistanceBetweenBodyAndWall) {
  const int body_mm = HalvedDepthOf(30.0, 30.0, 30.0, 30.0);
  const int wall_mm = HalvedDepthOf(15.0, 15.0, 15.0, 15.0);
  EXPECT_EQ(HalvedDepthOf(30.0, 30.0, 30.0, 15.0), body_mm);
  EXPECT_EQ(HalvedDepthOf(30.0, 15.0, 30.0, 15.0), body_mm);
  EXPECT_EQ(HalvedDepthOf(30.0, 15.0, 15.0, 15.0), wall_mm);
}

TEST(DepthConverter, HalvingPassesOverInvalidOnes) {
  EXPECT_EQ(HalvedDepthOf(0.0, 30.0, 0.0, 0.0), 2000);
  EXPECT_EQ(HalvedDepthOf(0.0, 0.0, 0.0, 0.0), 0);
  EXPECT_EQ(HalvedDepthOf(0.0, 0.0, 15.0, 30.0), 2000);
}

TEST(DepthConverter, HalvingAnOddSizeLeavesOutTheMiddleRowAndColumn) {
  cv::Mat disparity(5, 5, CV_16SC1, cv::Scalar(480));
  disparity.row(2) = cv::Scalar(240);
  disparity.col(2) = cv::Scalar(240);
  cv::Mat depth_mm;
  DepthConverter(kGeometry, kSearched).ConvertHalved(disparity, depth_mm);
  EXPECT_EQ(depth_mm.size(), cv::Size(2, 2));
  EXPECT_EQ(cv::countNonZero(depth_mm == 2000), 4);
}

TEST(DepthConverter, RefusesAGeometryThatMakesNoDistances) {
  EXPECT_THROW(DepthConverter({0.0, 0.12, 0.5, 10.0}, 64), std::logic_error);
  EXPECT_THROW(DepthConverter({500.0, 0.12, 0.5, 70.0}, 64), std::logic_error);
}

}  // namespace
}  // namespace deixis::stereo_driver
