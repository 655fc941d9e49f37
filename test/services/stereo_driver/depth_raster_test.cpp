#include "services/stereo_driver/core/depth_camera/depth_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <opencv2/core.hpp>

namespace deixis::stereo_driver {
namespace {

class DepthRasterTest : public testing::Test {
 protected:
  static DepthQuad Square(float left, float top, float side, float z_mm) {
    return {{{left, top, z_mm},
             {left + side, top, z_mm},
             {left, top + side, z_mm},
             {left + side, top + side, z_mm}}};
  }
  int Filled() const { return cv::countNonZero(depth_mm_); }
  std::uint16_t At(int x, int y) const { return depth_mm_.at<std::uint16_t>(y, x); }

  cv::Mat depth_mm_ = cv::Mat::zeros(20, 30, CV_16UC1);
  DepthRaster raster_{depth_mm_};
};

TEST_F(DepthRasterTest, FillsThePixelsWhoseCentresLieInside) {
  raster_.Fill(Square(3.4F, 5.4F, 2.2F, 700.0F));
  EXPECT_EQ(Filled(), 4);
  EXPECT_EQ(At(4, 6), 700);
  EXPECT_EQ(At(5, 7), 700);
}

TEST_F(DepthRasterTest, LeavesOutWhatLiesBetweenCentres) {
  raster_.Fill(Square(3.1F, 5.1F, 0.8F, 700.0F));
  EXPECT_EQ(Filled(), 0);
}

TEST_F(DepthRasterTest, InterpolatesBetweenTheCorners) {
  raster_.Fill({{{0, 0, 1000}, {10, 0, 1010}, {0, 10, 1020}, {10, 10, 1030}}});
  EXPECT_EQ(At(5, 0), 1005);
  EXPECT_EQ(At(0, 5), 1010);
  EXPECT_EQ(At(7, 9), 1025);
}

TEST_F(DepthRasterTest, FillsWhateverWayTheQuadIsTurned) {
  DepthQuad turned = Square(3.0F, 3.0F, 4.0F, 700.0F);
  std::swap(turned[0], turned[3]);
  raster_.Fill(turned);
  EXPECT_EQ(Filled(), 25);
  depth_mm_.setTo(0);
  DepthQuad mirrored = Square(3.0F, 3.0F, 4.0F, 700.0F);
  std::swap(mirrored[0], mirrored[1]);
  std::swap(mirrored[2], mirrored[3]);
  raster_.Fill(mirrored);
  EXPECT_EQ(Filled(), 25);
}

TEST_F(DepthRasterTest, LetsTheNearestWinInEitherOrder) {
  raster_.Fill(Square(2.0F, 2.0F, 3.0F, 700.0F));
  raster_.Fill(Square(2.0F, 2.0F, 3.0F, 900.0F));
  EXPECT_EQ(At(3, 3), 700);
  raster_.Fill(Square(2.0F, 2.0F, 3.0F, 400.0F));
  EXPECT_EQ(At(3, 3), 400);
}

TEST_F(DepthRasterTest, CutsAtTheBorders) {
  raster_.Fill(Square(-1e9F, -1e9F, 2e9F, 700.0F));
  raster_.Fill(Square(27.5F, 17.5F, 100.0F, 300.0F));
  raster_.Fill(Square(40.0F, 3.0F, 5.0F, 100.0F));
  raster_.Fill(Square(-9.0F, 3.0F, 5.0F, 100.0F));
  EXPECT_EQ(At(29, 19), 300);
  EXPECT_EQ(cv::countNonZero(depth_mm_ == 100), 0);
}

TEST_F(DepthRasterTest, FillsNothingWithWhatIsNoArea) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  raster_.Fill({{{3, 3, 700}, {5, 3, 700}, {4, 3, 700}, {9, 3, 700}}});
  raster_.Fill({{{nan, 3, 700}, {5, nan, 700}, {nan, 7, 700}, {nan, nan, 700}}});
  EXPECT_EQ(Filled(), 0);
}

TEST_F(DepthRasterTest, LeavesOutWhatLiesBehindTheCamera) {
  raster_.Fill(Square(2.0F, 2.0F, 3.0F, -1000.0F));
  raster_.Fill(Square(8.0F, 2.0F, 3.0F, -1e9F));
  EXPECT_EQ(Filled(), 0);
  raster_.Fill({{{0, 10, -50}, {10, 10, 50}, {0, 14, -50}, {10, 14, 50}}});
  EXPECT_EQ(At(2, 12), 0);
  EXPECT_EQ(At(8, 12), 30);
}

TEST(SpanOf, IsEmptyWhereACornerIsNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  const auto length = [](float a, float b, float c, float d) {
    const Span span = SpanOf(a, b, c, d, 639.0F);
    return std::max(0, span.last - span.first + 1);
  };
  EXPECT_EQ(length(2.0F, 5.0F, 2.0F, 5.0F), 4);
  EXPECT_EQ(length(-1e30F, 1e30F, 0.0F, 0.0F), 640);
  EXPECT_EQ(length(nan, nan, nan, nan), 0);
  EXPECT_EQ(length(-infinite, infinite, infinite, -infinite), 0);
  for (const float bad : {nan, infinite, -infinite}) {
    EXPECT_EQ(length(bad, 5.0F, 2.0F, 5.0F), 0);
    EXPECT_EQ(length(2.0F, bad, 2.0F, 5.0F), 0);
    EXPECT_EQ(length(2.0F, 5.0F, bad, 5.0F), 0);
    EXPECT_EQ(length(2.0F, 5.0F, 2.0F, bad), 0);
  }
}

TEST_F(DepthRasterTest, KeepsTheFarthestThatSixteenBitsSay) {
  raster_.Fill(Square(2.0F, 2.0F, 3.0F, 65535.0F));
  EXPECT_EQ(At(3, 3), 65535);
}

}  // namespace
}  // namespace deixis::stereo_driver
