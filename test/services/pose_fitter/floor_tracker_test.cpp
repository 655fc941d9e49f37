#include "services/pose_fitter/core/floor/floor_tracker.h"

#include <gtest/gtest.h>

#include "services/pose_fitter/core/depth/sound_depth.h"
#include "test/services/pose_fitter/synthetic_room.h"
#include "test/support/allocation_count.h"

namespace deixis::pose_fitter {
namespace {

using test::Box;
using test::Room;

class FloorTrackerTest : public ::testing::Test {
 protected:
  const std::optional<body_model::Floor>& See(const Room& room, double noise_per_square_m = 0.003) {
    return See(test::Look(room, 320, noise_per_square_m));
  }
  const std::optional<body_model::Floor>& See(const test::Picture& picture,
                                              const std::optional<body_model::Floor>& known = {}) {
    view_.Update(picture.camera, picture.depth_mm);
    time_s_ += 0.1;
    return tracker_.Update(view_, sound_.Find(view_), time_s_, known);
  }
  static void ExpectNear(const std::optional<body_model::Floor>& found,
                         const body_model::Floor& truth) {
    ASSERT_TRUE(found);
    EXPECT_LT(std::acos(std::min(1.0, found->normal.dot(truth.normal))), 0.01);
    EXPECT_NEAR(found->offset_m, truth.offset_m, 0.02);
    EXPECT_NEAR(found->normal.norm(), 1.0, 1e-9);
  }

  DepthView view_;
  SoundDepth sound_;
  FloorTracker tracker_;
  double time_s_ = 0.0;
};

TEST_F(FloorTrackerTest, FindsTheFloorOfARoomWithPeople) {
  Room room;
  room.AddStanding(-0.5, 2.2, 1);
  room.AddStanding(0.6, 3.0, 2);
  ExpectNear(See(room), room.Floor());
}

TEST_F(FloorTrackerTest, FindsItThroughPitchAndRoll) {
  for (const double pitch : {0.0, 0.3, 0.9}) {
    for (const double roll : {-0.4, 0.0, 0.4}) {
      Room room;
      room.pitch_rad = pitch;
      room.roll_rad = roll;
      room.camera_height_m = 0.7;
      ExpectNear(See(room), room.Floor());
      tracker_.Reset();
    }
  }
}

TEST_F(FloorTrackerTest, IsNotFooledByALargeTable) {
  Room room;
  room.AddTable(0.0, 1.6, 0.8, 0.5, 0.75);
  ExpectNear(See(room), room.Floor());
}

TEST_F(FloorTrackerTest, IsNotFooledByABed) {
  Room room;
  room.pitch_rad = 0.35;
  room.Add(Box{{-1.5, 1.5, 0.0}, {0.5, 3.4, 0.5}});
  ExpectNear(See(room), room.Floor());
}

TEST_F(FloorTrackerTest, SaysNothingOfCeilingAndWalls) {
  Room room;
  room.has_floor = false;
  room.Add(Box{{-3.0, 0.5, 2.4}, {3.0, 4.5, 2.5}});
  room.pitch_rad = -0.3;
  EXPECT_FALSE(See(room));
}

TEST_F(FloorTrackerTest, SaysNothingWhereOnlyPeopleAreSeen) {
  Room room;
  room.has_floor = false;
  room.wall_m = 0.0;
  room.AddStanding(0.0, 1.5, 1);
  EXPECT_FALSE(See(room));
}

TEST_F(FloorTrackerTest, SaysNothingOfAPlaneThatASurfaceOnlySwingsAbout) {
  Room room;
  room.pitch_rad = 0.5;
  test::Picture picture = test::Look(room, 320, 0.003);
  const body_model::Floor plane = room.Floor();
  for (const double swing_m : {0.0, 0.07}) {
    for (int v = 0; v < picture.depth_mm.rows; ++v) {
      for (int u = 0; u < picture.depth_mm.cols; ++u) {
        const double towards = -plane.normal.dot(picture.camera.Ray(u, v));
        const double off_m = swing_m * std::sin(0.12 * u);
        const double z_m = towards > 0.0 ? (plane.offset_m - off_m) / towards : 0.0;
        picture.depth_mm.at<std::uint16_t>(v, u) =
            static_cast<std::uint16_t>(z_m < 6.0 ? 1000.0 * z_m : 0.0);
      }
    }
    tracker_.Reset();
    EXPECT_EQ(See(picture).has_value(), swing_m == 0.0) << swing_m;
  }
}

TEST_F(FloorTrackerTest, SaysNothingOfNothing) {
  const cv::Mat nothing(240, 320, CV_16UC1, cv::Scalar(0));
  const cv::Mat pixel(1, 1, CV_16UC1, cv::Scalar(1000));
  EXPECT_FALSE(See({{320, 240, {280, 280}, {160, 120}, {}}, nothing, {}}));
  EXPECT_FALSE(See({{1, 1, {1, 1}, {0, 0}, {}}, pixel, {}}));
}

TEST_F(FloorTrackerTest, HoldsAFloorThatSomebodyHidesForAWhile) {
  Room room;
  See(room);
  Room hidden = room;
  hidden.Add(Box{{-1.0, 0.5, 0.0}, {1.0, 0.6, 3.0}});
  const test::Picture picture = test::Look(hidden);
  ExpectNear(See(picture), room.Floor());
  for (int i = 0; i < 12; ++i) See(picture);
  EXPECT_FALSE(tracker_.floor());
}

TEST_F(FloorTrackerTest, FollowsAMovingCamera) {
  for (int i = 0; i < 15; ++i) {
    Room room;
    room.pitch_rad = 0.1 + 0.02 * i;
    room.camera_height_m = 1.0 + 0.02 * i;
    ExpectNear(See(room), room.Floor());
  }
}

TEST_F(FloorTrackerTest, SmoothsTheNoiseOfAStillCamera) {
  double jumps_m = 0.0, smooth_jumps_m = 0.0;
  std::optional<double> last_m, last_smooth_m;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const test::Picture picture = test::Look({}, 320, 0.005, seed);
    const double smooth_m = See(picture)->offset_m;
    FloorTracker fresh;
    const double once_m = fresh.Update(view_, sound_.Find(view_), time_s_)->offset_m;
    jumps_m += std::abs(once_m - last_m.value_or(once_m));
    smooth_jumps_m += std::abs(smooth_m - last_smooth_m.value_or(smooth_m));
    last_m = once_m;
    last_smooth_m = smooth_m;
    EXPECT_NEAR(smooth_m, 1.2, 0.02);
  }
  EXPECT_LT(smooth_jumps_m, 0.6 * jumps_m);
}

TEST_F(FloorTrackerTest, PutsWhatTheMountTellsRight) {
  Room room;
  body_model::Floor rough = room.Floor();
  rough.offset_m += 0.03;
  ExpectNear(See(test::Look(room), rough), room.Floor());
}

TEST_F(FloorTrackerTest, TakesWhatTheMountTellsWhereNoFloorIsSeen) {
  Room room;
  room.AddTable(0.0, 1.2, 1.5, 1.0, 0.75);
  room.has_floor = false;
  const auto known = See(test::Look(room), room.Floor());
  ASSERT_TRUE(known);
  EXPECT_EQ(known->offset_m, 1.2);
}

TEST_F(FloorTrackerTest, FindsTheSameFloorInTheSamePictures) {
  const test::Picture picture = test::Look({});
  const body_model::Floor first = *See(picture);
  FloorTracker other;
  const auto second = other.Update(view_, sound_.Find(view_), time_s_);
  EXPECT_EQ(first.normal, second->normal);
  EXPECT_EQ(first.offset_m, second->offset_m);
}

TEST_F(FloorTrackerTest, TakesItsMemoryOnce) {
  const test::Picture picture = test::Look({});
  See(picture);
  const std::size_t before = deixis::test::AllocatedBytes();
  for (int i = 0; i < 8; ++i) {
    tracker_.Update(view_, sound_.Find(view_), time_s_ + 0.1 * i);
  }
  EXPECT_EQ(deixis::test::AllocatedBytes(), before);
}

}  // namespace
}  // namespace deixis::pose_fitter
