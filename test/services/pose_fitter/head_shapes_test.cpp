#include "services/pose_fitter/core/people/head_shapes.h"

#include <gtest/gtest.h>

#include "services/pose_fitter/core/depth/sound_depth.h"
#include "test/services/pose_fitter/synthetic_room.h"
#include "test/support/allocation_count.h"

namespace deixis::pose_fitter {
namespace {

using test::Ball;
using test::Box;
using test::Room;

constexpr double kCertain = 0.9;

class HeadShapesTest : public ::testing::Test {
 protected:
  const std::vector<HeadShape>& Find(const Room& room, double noise_per_square_m = 0.002) {
    return Find(test::Look(room, 320, noise_per_square_m), room.Floor().normal);
  }
  const std::vector<HeadShape>& Find(const test::Picture& picture, const Eigen::Vector3d& up) {
    view_.Update(picture.camera, picture.depth_mm);
    return heads_.Find(view_, sound_.Find(view_), up, 0.4, 6.0);
  }
  double Best() const { return found().empty() ? 0.0 : found().front().likeness; }
  const std::vector<HeadShape>& found() const { return heads_.found(); }

  DepthView view_;
  SoundDepth sound_;
  HeadShapes heads_;
};

TEST_F(HeadShapesTest, FindsTheHeadOfSomebodyNearAndFar) {
  for (const double y : {2.7, 3.4, 4.2}) {
    Room room;
    room.AddStanding(0.2, y, 1);
    ASSERT_FALSE(Find(room).empty()) << y;
    EXPECT_GE(Best(), kCertain) << y;
    EXPECT_NEAR(found()[0].middle_m.x(), 0.2, 0.05) << y;
    const double height_m = room.Floor().normal.dot(found()[0].top_m) + room.camera_height_m;
    EXPECT_NEAR(height_m, 1.72, 0.1) << y;
  }
}

TEST_F(HeadShapesTest, FindsItAboveASofaThatTheBodySitsIn) {
  Room room;
  room.AddSeated(0.0, 2.5, 1);
  room.Add(Box{{-1.5, 2.6, 0.0}, {1.5, 3.2, 0.85}});
  ASSERT_FALSE(Find(room).empty());
  EXPECT_GE(Best(), kCertain);
  EXPECT_NEAR(found()[0].middle_m.x(), 0.0, 0.05);
}

TEST_F(HeadShapesTest, FindsOneHeadForEachOfTwoPeople) {
  Room room;
  room.AddStanding(-0.5, 2.4, 1);
  room.AddStanding(0.5, 3.0, 2, 1.6);
  Find(room);
  int certain = 0;
  for (const HeadShape& head : found()) certain += head.likeness >= kCertain ? 1 : 0;
  EXPECT_EQ(certain, 2);
}

TEST_F(HeadShapesTest, IsNotFooledByEdgesAndCornersOfFurniture) {
  for (const double half_m : {0.15, 0.3, 0.6}) {
    Room room;
    room.Add(Box{{-half_m, 2.4, 0.0}, {half_m, 2.8, 1.6}});
    Find(room, 0.0005);
    EXPECT_LT(Best(), 0.8) << half_m;
  }
  Room room;
  room.wall_m = 3.0;
  EXPECT_TRUE(Find(room).empty()) << "an empty room";
}

TEST_F(HeadShapesTest, WantsATrunkBelowABall) {
  Room room;
  room.Add(Ball{{0.0, 2.4, 1.5}, 0.1});
  Find(room);
  EXPECT_LT(Best(), 0.8);
}

TEST_F(HeadShapesTest, SeesNothingWhereNothingWasMeasured) {
  test::Picture picture = test::Look(Room());
  picture.depth_mm.setTo(0);
  EXPECT_TRUE(Find(picture, -Eigen::Vector3d::UnitY()).empty());
}

TEST_F(HeadShapesTest, TakesItsMemoryOnce) {
  Room room;
  room.AddStanding(0.0, 2.5, 1);
  const test::Picture picture = test::Look(room);
  Find(picture, room.Floor().normal);
  view_.Update(picture.camera, picture.depth_mm);
  const auto& is_sound = sound_.Find(view_);
  const auto before = deixis::test::AllocatedBytes();
  heads_.Find(view_, is_sound, room.Floor().normal, 0.4, 6.0);
  EXPECT_EQ(deixis::test::AllocatedBytes(), before);
}

TEST(HeadShapesConfig, RefusesValuesThatAreNone) {
  HeadShapesConfig config;
  EXPECT_NO_THROW(config.Validate());
  config.radius_m = 0.0;
  EXPECT_THROW(config.Validate(), config::FaultsFound);
  config = {};
  config.least_share = 1.5;
  EXPECT_THROW(config.Validate(), config::FaultsFound);
}

}  // namespace
}  // namespace deixis::pose_fitter
