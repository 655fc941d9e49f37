#include "services/pose_fitter/core/people/people_finder.h"

#include <gtest/gtest.h>

#include <array>
#include <opencv2/core.hpp>

#include "services/pose_fitter/core/depth/sound_depth.h"
#include "test/services/pose_fitter/synthetic_room.h"
#include "test/support/allocation_count.h"

namespace deixis::pose_fitter {
namespace {

using test::Box;
using test::Room;

class PeopleFinderTest : public ::testing::Test {
 protected:
  const PeopleRegions& Find(const Room& room, int width_px = 320,
                            double noise_per_square_m = 0.002) {
    picture_ = test::Look(room, width_px, noise_per_square_m);
    return Find(room.has_floor ? std::optional(room.Floor()) : std::nullopt);
  }
  const PeopleRegions& Find(const std::optional<body_model::Floor>& floor) {
    view_.Update(picture_.camera, picture_.depth_mm);
    return finder_.Find(view_, sound_.Find(view_), floor);
  }

  /// Share of the person's pixels that the region which holds most of them has.
  double Recall(int owner) const {
    std::array<int, 256> shared{};
    int all = 0;
    for (int i = 0; i < static_cast<int>(picture_.owner.total()); ++i) {
      if (picture_.owner.at<std::uint8_t>(i) != owner) continue;
      ++all;
      ++shared[finder_.regions().labels[static_cast<std::size_t>(i)]];
    }
    return 1.0 * *std::max_element(shared.begin() + 1, shared.end()) / all;
  }
  /// Share of the pixels of all regions that are nobody.
  double WrongShare() const {
    int wrong = 0, all = 0;
    for (int i = 0; i < static_cast<int>(picture_.owner.total()); ++i) {
      if (finder_.regions().labels[static_cast<std::size_t>(i)] == 0) continue;
      ++all;
      wrong += picture_.owner.at<std::uint8_t>(i) == 0;
    }
    return all == 0 ? 0.0 : 1.0 * wrong / all;
  }

  test::Picture picture_;
  DepthView view_;
  SoundDepth sound_;
  PeopleFinder finder_;
};

TEST_F(PeopleFinderTest, FindsSomebodyStanding) {
  Room room;
  room.AddStanding(0.3, 2.5, 1);
  const PeopleRegions& found = Find(room);
  ASSERT_EQ(found.regions.size(), 1U);
  EXPECT_GT(Recall(1), 0.97);
  EXPECT_LT(WrongShare(), 0.02);
  EXPECT_NEAR(found.regions[0].top_m, 1.74, 0.05);
  EXPECT_NEAR(found.regions[0].bottom_m, 0.04, 0.05);
  EXPECT_NEAR(found.regions[0].centroid_m.z(), 2.5, 0.2);
  EXPECT_NEAR(found.regions[0].centroid_m.x(), 0.3, 0.05);
}

TEST_F(PeopleFinderTest, FindsPeopleOfAllSizesNearAndFar) {
  for (const double stature : {0.95, 1.4, 1.95}) {
    for (const double y : {1.8, 3.8}) {
      Room room;
      room.AddStanding(0.0, y, 1, stature);
      EXPECT_EQ(Find(room).regions.size(), 1U) << stature << ' ' << y;
      EXPECT_GT(Recall(1), 0.9) << stature << ' ' << y;
    }
  }
}

TEST_F(PeopleFinderTest, FindsThemInPicturesOfOtherSizes) {
  Room room;
  room.AddStanding(0.0, 2.5, 1);
  for (const int width : {160, 640}) {
    EXPECT_EQ(Find(room, width).regions.size(), 1U) << width;
    EXPECT_GT(Recall(1), 0.95) << width;
  }
}

TEST_F(PeopleFinderTest, TellsTwoPeopleApartOfWhomOneHidesAPartOfTheOther) {
  Room room;
  room.AddStanding(-0.1, 2.0, 1);
  room.AddStanding(0.25, 3.0, 2);
  EXPECT_EQ(Find(room).regions.size(), 2U);
  EXPECT_GT(Recall(1), 0.95);
  EXPECT_GT(Recall(2), 0.9);
}

TEST_F(PeopleFinderTest, FindsSomebodyOnAChair) {
  Room room;
  room.AddSeated(0.0, 2.5, 1);
  ASSERT_GE(Find(room).regions.size(), 1U);
  EXPECT_GT(Recall(1), 0.9);
}

TEST_F(PeopleFinderTest, KeepsAPersonBehindATableInOnePiece) {
  Room room;
  room.AddStanding(0.0, 2.6, 1);
  room.AddTable(0.0, 1.7, 0.6, 0.3, 0.75);
  Find(room);
  EXPECT_GT(Recall(1), 0.9);
  EXPECT_LT(WrongShare(), 0.15);
}

TEST_F(PeopleFinderTest, KeepsAnArmBeforeTheTrunkWithIt) {
  Room room;
  room.AddStanding(0.0, 2.5, 1);
  for (int i = 0; i < 8; ++i) room.Add(test::Ball{{0.2 - 0.05 * i, 2.15, 1.1}, 0.045}, 1);
  EXPECT_EQ(Find(room).regions.size(), 1U);
  EXPECT_GT(Recall(1), 0.97);
}

TEST_F(PeopleFinderTest, FindsSomebodyCutByTheBorder) {
  Room room;
  room.AddStanding(1.15, 2.0, 1);
  Find(room);
  ASSERT_GT(cv::countNonZero(picture_.owner), 500);
  EXPECT_GT(Recall(1), 0.9);
}

TEST_F(PeopleFinderTest, TellsTwoWhoTouchApartByTheirSeeds) {
  Room room;
  room.AddStanding(-0.18, 2.5, 1);
  room.AddStanding(0.25, 2.5, 2);
  for (int i = 0; i < 6; ++i) room.Add(test::Ball{{-0.05 + 0.05 * i, 2.45, 1.3}, 0.06}, 1);
  Find(room);
  EXPECT_LT(finder_.regions().regions.size(), 2U) << "else the seeds show nothing";
  // Where they were expected: a little beside.
  std::vector<std::uint8_t> seeds(picture_.owner.total(), 0);
  for (int v = 0; v < 240; ++v) {
    for (int u = 4; u < 320; ++u) {
      seeds[static_cast<std::size_t>(v * 320 + u)] =
          static_cast<std::uint8_t>(3 * picture_.owner.at<std::uint8_t>(v, u - 4));
    }
  }
  finder_.Find(view_, sound_.Find(view_), room.Floor(), seeds);
  ASSERT_EQ(finder_.regions().regions.size(), 2U);
  EXPECT_GT(Recall(1), 0.9);
  EXPECT_GT(Recall(2), 0.9);
  EXPECT_LT(WrongShare(), 0.05);
  const auto& regions = finder_.regions().regions;
  EXPECT_EQ(regions[0].seed + regions[1].seed, 3 + 6);
}

TEST_F(PeopleFinderTest, FindsWhoIsExpectedAtAWall) {
  Room room;
  room.wall_m = 2.6;
  room.AddStanding(0.0, 2.55, 1);
  Find(room);
  EXPECT_LT(Recall(1), 0.5) << "else the seeds show nothing";
  std::vector<std::uint8_t> seeds(picture_.owner.begin<std::uint8_t>(),
                                  picture_.owner.end<std::uint8_t>());
  finder_.Find(view_, sound_.Find(view_), room.Floor(), seeds);
  EXPECT_GT(Recall(1), 0.9);
}

TEST_F(PeopleFinderTest, RefusesSeedsOfAnotherSize) {
  Find(Room());
  EXPECT_THROW(finder_.Find(view_, sound_.Find(view_), {}, std::vector<std::uint8_t>(7)),
               std::logic_error);
}

TEST_F(PeopleFinderTest, SeesNobodyInAnEmptyRoom) { EXPECT_TRUE(Find(Room()).regions.empty()); }

TEST_F(PeopleFinderTest, SeesNobodyInFurniture) {
  Room room;
  room.AddTable(-1.0, 2.2, 0.6, 0.4, 0.72);
  room.Add(Box{{0.5, 3.0, 0.0}, {1.3, 3.5, 1.9}});
  room.Add(Box{{-0.4, 3.8, 0.0}, {0.2, 4.2, 0.9}});
  EXPECT_TRUE(Find(room).regions.empty());
}

TEST_F(PeopleFinderTest, FindsSomebodyWithoutAFloor) {
  Room room;
  room.has_floor = false;
  room.wall_m = 0.0;
  room.pitch_rad = 0.0;
  room.AddStanding(0.0, 2.5, 1);
  ASSERT_EQ(Find(room).regions.size(), 1U);
  EXPECT_GT(Recall(1), 0.95);
  EXPECT_NEAR(Find(room).regions[0].top_m, 1.75, 0.15);
}

TEST_F(PeopleFinderTest, FindsHeadAndShouldersBeforeTheCamera) {
  Room room;
  room.has_floor = false;
  room.pitch_rad = 0.0;
  room.camera_height_m = 1.5;
  room.wall_m = 2.6;
  room.AddStanding(0.0, 0.9, 1);
  ASSERT_EQ(Find(room).regions.size(), 1U);
  EXPECT_GT(Recall(1), 0.95);
}

TEST_F(PeopleFinderTest, FindsSomebodyWhoIsOneSurfaceWithASofa) {
  Room room;
  room.AddSeated(0.0, 2.5, 1);
  room.Add(Box{{-1.5, 2.35, 0.0}, {1.5, 3.2, 0.85}});  // Its back at his own.
  const PeopleRegions& found = Find(room);
  ASSERT_FALSE(found.heads.empty());
  EXPECT_GT(Recall(1), 0.5);
  const HeadShape& head = found.heads[0];
  EXPECT_NE(found.labels[static_cast<std::size_t>(head.v_px * 320 + head.u_px)], 0);
}

TEST_F(PeopleFinderTest, SeesNobodyWhereNothingWasMeasured) {
  picture_ = test::Look({});
  picture_.depth_mm.setTo(0);
  EXPECT_TRUE(Find(std::nullopt).regions.empty());
  EXPECT_TRUE(Find(Room().Floor()).regions.empty());
}

TEST_F(PeopleFinderTest, TakesAPictureOfOnePixel) {
  picture_ = {{1, 1, {1, 1}, {0, 0}, {}}, cv::Mat(1, 1, CV_16UC1, cv::Scalar(2000)), {}};
  EXPECT_TRUE(Find(Room().Floor()).regions.empty());
  EXPECT_EQ(finder_.regions().labels.size(), 1U);
}

TEST_F(PeopleFinderTest, SurvivesNoiseInsteadOfAPicture) {
  picture_ = test::Look({});
  cv::RNG random(7);
  random.fill(picture_.depth_mm, cv::RNG::UNIFORM, 0, 65535);
  for (const PersonRegion& region : Find(Room().Floor()).regions) {
    EXPECT_TRUE(region.centroid_m.allFinite());
  }
}

TEST_F(PeopleFinderTest, CountsPixelsAndBoxesAsItsLabelsSay) {
  Room room;
  room.AddStanding(-0.5, 2.5, 1);
  room.AddStanding(0.6, 3.0, 2);
  for (const PersonRegion& region : Find(room).regions) {
    int count = 0;
    cv::Rect box;
    for (int v = 0; v < picture_.camera.height_px; ++v) {
      for (int u = 0; u < picture_.camera.width_px; ++u) {
        const auto at = static_cast<std::size_t>(v * picture_.camera.width_px + u);
        if (finder_.regions().labels[at] != region.label) continue;
        ++count;
        box |= cv::Rect(u, v, 1, 1);
      }
    }
    EXPECT_EQ(count, region.pixel_count);
    EXPECT_EQ(box, region.box_px);
  }
}

TEST_F(PeopleFinderTest, TakesItsMemoryOnce) {
  Room room;
  room.AddStanding(-0.5, 2.5, 1);
  room.AddTable(-1.0, 2.2, 0.6, 0.4, 0.72);
  Find(room);
  const auto floor = std::optional(room.Floor());
  const std::size_t before = deixis::test::AllocatedBytes();
  Find(floor);
  EXPECT_EQ(deixis::test::AllocatedBytes(), before);
}

}  // namespace
}  // namespace deixis::pose_fitter
