#include "services/pose_fitter/core/depth/sound_depth.h"

#include <gtest/gtest.h>

#include <numeric>
#include <opencv2/core.hpp>

#include "test/services/pose_fitter/synthetic_room.h"
#include "test/support/allocation_count.h"

namespace deixis::pose_fitter {
namespace {

/// 40x30 pixels of a wall.
class SoundDepthTest : public ::testing::Test {
 protected:
  SoundDepthTest() : depth_mm_(30, 40, CV_16UC1, cv::Scalar(3000)) {}

  bool IsSound(int u, int v) {
    DepthView view;
    view.Update({40, 30, {35, 35}, {20, 15}, {0.002, 0.002}}, depth_mm_);
    return sound_.Find(view)[static_cast<std::size_t>(v * 40 + u)] != 0;
  }

  cv::Mat depth_mm_;
  SoundDepth sound_;
};

TEST_F(SoundDepthTest, TrustsAWallUpToTheBorder) {
  for (const int u : {0, 1, 20, 39}) {
    for (const int v : {0, 1, 15, 29}) EXPECT_TRUE(IsSound(u, v)) << u << ' ' << v;
  }
}

TEST_F(SoundDepthTest, DoubtsAPixelBetweenFrontAndBack) {
  depth_mm_(cv::Rect(0, 0, 20, 30)).setTo(1000);
  depth_mm_.col(20).setTo(2000);
  EXPECT_FALSE(IsSound(20, 15));
  EXPECT_TRUE(IsSound(19, 15));
  EXPECT_TRUE(IsSound(21, 15));
}

TEST_F(SoundDepthTest, DoubtsASpurOnePixelWideButNoLimb) {
  depth_mm_(cv::Rect(10, 5, 1, 20)).setTo(1000);
  depth_mm_(cv::Rect(20, 5, 2, 20)).setTo(1000);
  EXPECT_FALSE(IsSound(10, 15));
  EXPECT_TRUE(IsSound(20, 15));
  EXPECT_TRUE(IsSound(21, 15));
}

TEST_F(SoundDepthTest, TrustsASteepSlope) {
  for (int u = 0; u < 40; ++u) depth_mm_.col(u).setTo(1000 + 150 * u);  // 79 degrees at 1 m.
  EXPECT_TRUE(IsSound(1, 15));
  EXPECT_TRUE(IsSound(20, 15));
}

TEST_F(SoundDepthTest, LeavesWhatWasNotMeasuredInvalidAndItsNeighboursAlone) {
  depth_mm_.at<std::uint16_t>(15, 20) = 0;
  EXPECT_FALSE(IsSound(20, 15));
  EXPECT_TRUE(IsSound(19, 15));
  EXPECT_TRUE(IsSound(20, 16));
}

TEST(SoundDepth, KeepsPeople) {
  test::Room room;
  room.AddStanding(-0.6, 2.0, 1);
  room.AddStanding(0.5, 3.5, 1);
  const test::Picture picture = test::Look(room, 320, 0.003);
  DepthView view;
  view.Update(picture.camera, picture.depth_mm);
  SoundDepth sound;
  const auto& is_sound = sound.Find(view);
  int lost = 0;
  for (int i = 0; i < static_cast<int>(picture.owner.total()); ++i) {
    lost += picture.owner.at<std::uint8_t>(i) != 0 && is_sound[static_cast<std::size_t>(i)] == 0;
  }
  EXPECT_LT(lost, 0.02 * cv::countNonZero(picture.owner));
}

TEST(SoundDepth, TakesTheSmallestPicture) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(2, 1), cv::Size(1, 2)}) {
    DepthView view;
    view.Update({size.width, size.height, {1, 1}, {0, 0}, {}},
                cv::Mat(size, CV_16UC1, cv::Scalar(1000)));
    SoundDepth sound;
    const auto& is_sound = sound.Find(view);
    EXPECT_EQ(std::accumulate(is_sound.begin(), is_sound.end(), 0), size.area());
  }
}

TEST(SoundDepth, TakesItsMemoryOnce) {
  const test::Picture picture = test::Look({});
  DepthView view;
  view.Update(picture.camera, picture.depth_mm);
  SoundDepth sound;
  sound.Find(view);
  const std::size_t before = deixis::test::AllocatedBytes();
  sound.Find(view);
  EXPECT_EQ(deixis::test::AllocatedBytes(), before);
}

}  // namespace
}  // namespace deixis::pose_fitter
