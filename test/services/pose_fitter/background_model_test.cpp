#include "services/pose_fitter/core/people/background_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <opencv2/core.hpp>

#include "services/pose_fitter/core/depth/sound_depth.h"
#include "services/pose_fitter/core/people/people_finder.h"
#include "test/services/pose_fitter/synthetic_room.h"
#include "test/support/allocation_count.h"

namespace deixis::pose_fitter {
namespace {

using test::Box;
using test::Room;

class BackgroundModelTest : public ::testing::Test {
 protected:
  BackgroundModelTest() : model_(Used()) {}

  static BackgroundModelConfig Used() {
    BackgroundModelConfig config;
    config.is_used = true;
    return config;
  }

  /// The foreground of a room after `seconds` of it, ten images each.
  const std::vector<std::uint8_t>& See(const Room& room, double seconds,
                                       const std::vector<std::uint8_t>& is_occupied = {}) {
    picture_ = test::Look(room, 160, 0.002, ++seed_);
    view_.Update(picture_.camera, picture_.depth_mm);
    const auto& is_sound = sound_.Find(view_);
    for (double t = 0.0; t < seconds; t += 0.1) {
      model_.Foreground(view_, is_sound);
      model_.Learn(view_, is_sound, is_occupied, 0.1);
    }
    foreground_ = model_.Foreground(view_, is_sound);
    return foreground_;
  }
  int Count() const { return std::accumulate(foreground_.begin(), foreground_.end(), 0); }
  int CountOf(int owner) const {
    int count = 0;
    for (int i = 0; i < static_cast<int>(picture_.owner.total()); ++i) {
      count +=
          picture_.owner.at<std::uint8_t>(i) == owner && foreground_[static_cast<std::size_t>(i)];
    }
    return count;
  }

  BackgroundModel model_;
  test::Picture picture_;
  DepthView view_;
  SoundDepth sound_;
  std::vector<std::uint8_t> foreground_;
  std::uint64_t seed_ = 0;
};

TEST_F(BackgroundModelTest, HoldsEverythingForForegroundAtFirst) {
  EXPECT_EQ(See(Room(), 0.0), sound_.Find(view_));
}

TEST_F(BackgroundModelTest, LearnsTheRoomAndSeesWhoComes) {
  Room room;
  See(room, 4.0);
  EXPECT_GT(model_.known_share(), 0.95);
  EXPECT_LT(Count(), 0.01 * 160 * 120);
  room.AddStanding(0.0, 2.5, 1);
  See(room, 0.1);
  EXPECT_GT(CountOf(1), 0.95 * cv::countNonZero(picture_.owner));
  EXPECT_LT(Count() - CountOf(1), 0.01 * 160 * 120);
}

TEST_F(BackgroundModelTest, LearnsNobodyWhoIsSaidToBeThere) {
  Room room;
  See(room, 4.0);
  room.AddStanding(0.0, 2.5, 1);
  See(room, 0.1);
  const std::vector<std::uint8_t> is_occupied = foreground_;
  See(room, 100.0, is_occupied);
  EXPECT_GT(CountOf(1), 0.9 * cv::countNonZero(picture_.owner));
}

TEST_F(BackgroundModelTest, UncoversSoonWhatSomebodyHid) {
  Room room, occupied;
  occupied.AddStanding(0.0, 2.5, 1);
  See(occupied, 4.0);
  See(room, 4.0);
  See(room, 3.1);
  EXPECT_LT(Count(), 0.01 * 160 * 120);
  See(occupied, 0.1);
  EXPECT_GT(CountOf(1), 0.9 * cv::countNonZero(picture_.owner));
}

TEST_F(BackgroundModelTest, ForgetsWhenTheCameraMoves) {
  Room room;
  See(room, 4.0);
  room.pitch_rad = 0.5;
  room.wall_m = 3.5;
  EXPECT_EQ(See(room, 0.0), sound_.Find(view_));
}

TEST_F(BackgroundModelTest, CanBeSwitchedOff) {
  BackgroundModelConfig config;
  config.is_used = false;
  BackgroundModel off(config);
  See(Room(), 0.0);
  const auto& is_sound = sound_.Find(view_);
  for (int i = 0; i < 100; ++i) off.Learn(view_, is_sound, {}, 0.1);
  EXPECT_EQ(off.Foreground(view_, is_sound), is_sound);
}

TEST_F(BackgroundModelTest, SetsApartSomebodyWhoLeansOnACupboard) {
  Room room;
  room.Add(Box{{0.15, 2.4, 0.0}, {1.2, 2.9, 1.6}});
  See(room, 4.0);
  room.AddStanding(0.0, 2.45, 1);
  See(room, 0.1);
  const int standing =
      static_cast<int>(std::count(foreground_.begin(), foreground_.end(), std::uint8_t{1}));
  const auto& is_sound = sound_.Find(view_);
  const int all = static_cast<int>(std::count(is_sound.begin(), is_sound.end(), std::uint8_t{1}));
  EXPECT_LT(standing, all / 3) << "the cupboard and the room are not in it";
  PeopleFinder finder;
  const auto regions = finder.Find(view_, foreground_, room.Floor()).regions;
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_GT(regions[0].pixel_count, standing / 2);
}

TEST_F(BackgroundModelTest, TakesItsMemoryOnce) {
  See(Room(), 1.0);
  const auto& is_sound = sound_.Find(view_);
  const std::vector<std::uint8_t> nowhere;
  const std::size_t before = deixis::test::AllocatedBytes();
  model_.Foreground(view_, is_sound);
  model_.Learn(view_, is_sound, nowhere, 0.1);
  EXPECT_EQ(deixis::test::AllocatedBytes(), before);
}

}  // namespace
}  // namespace deixis::pose_fitter
