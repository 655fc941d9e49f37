#include "services/object_detector/core/object_tracks.h"

#include <gtest/gtest.h>

namespace deixis::object_detector {
namespace {

constexpr scene::Box kBox{100, 100, 40, 40};
constexpr scene::Box kElsewhere{300, 100, 40, 40};

Timestamp Picture(int number) { return {number * 100'000}; }

class ObjectTracksTest : public testing::Test {
 protected:
  ObjectTracks Make() {
    return {config_, [this] { return next_id_++; }};
  }
  /// A track that has just been confirmed at picture 2.
  ObjectTracks Confirmed() {
    ObjectTracks tracks = Make();
    tracks.Propose(kBox, Picture(0));
    tracks.Hit(tracks.tracks()[0], kBox, Picture(1));
    tracks.Hit(tracks.tracks()[0], kBox, Picture(2));
    return tracks;
  }
  TrackingConfig config_;
  int next_id_ = 1000;
};

TEST_F(ObjectTracksTest, CountsAnObjectAfterItWasSeenAFewTimes) {
  ObjectTracks tracks = Make();
  tracks.Propose(kBox, Picture(0));
  tracks.Hit(tracks.tracks()[0], kBox, Picture(1));
  EXPECT_FALSE(tracks.tracks()[0].is_confirmed());
  tracks.Hit(tracks.tracks()[0], kBox, Picture(2));
  EXPECT_EQ(tracks.tracks()[0].id, 1000);
}

TEST_F(ObjectTracksTest, DropsANewObjectThatIsMissedAndSpendsNoIdOnIt) {
  ObjectTracks tracks = Make();
  tracks.Propose(kBox, Picture(0));
  for (int i = 0; i <= config_.early_misses; ++i) tracks.Miss(tracks.tracks()[0]);
  tracks.Tidy();
  EXPECT_TRUE(tracks.tracks().empty());
  EXPECT_EQ(next_id_, 1000);
}

TEST_F(ObjectTracksTest, KeepsAKnownObjectThatIsMissedUntilItsMemoryEnds) {
  ObjectTracks tracks = Confirmed();
  for (int i = 0; i < 20; ++i) tracks.Miss(tracks.tracks()[0]);
  tracks.Tidy();
  tracks.Forget(Picture(2 + 29));
  ASSERT_EQ(tracks.tracks().size(), 1u);
  EXPECT_EQ(tracks.tracks()[0].last_seen, Picture(2));
  tracks.Forget(Picture(2 + 31));
  EXPECT_TRUE(tracks.tracks().empty());
}

TEST_F(ObjectTracksTest, KeepsTheIdOfAnObjectThatIsFoundAgain) {
  ObjectTracks tracks = Confirmed();
  tracks.Miss(tracks.tracks()[0]);
  tracks.Propose(kBox, Picture(4));
  ASSERT_EQ(tracks.tracks().size(), 1u);
  EXPECT_EQ(tracks.tracks()[0].id, 1000);
  EXPECT_EQ(tracks.tracks()[0].misses_in_a_row, 0);
}

TEST_F(ObjectTracksTest, BeginsAnotherTrackElsewhere) {
  ObjectTracks tracks = Confirmed();
  tracks.Propose(kElsewhere, Picture(3));
  EXPECT_EQ(tracks.tracks().size(), 2u);
}

TEST_F(ObjectTracksTest, KeepsTheOlderOfTwoAtTheSamePlace) {
  ObjectTracks tracks = Confirmed();
  tracks.Propose(kElsewhere, Picture(3));
  tracks.Hit(tracks.tracks()[1], kBox, Picture(4));
  tracks.Hit(tracks.tracks()[1], kBox, Picture(5));
  tracks.Hit(tracks.tracks()[1], kBox, Picture(6));
  tracks.Hit(tracks.tracks()[1], kBox, Picture(7));
  tracks.Tidy();
  ASSERT_EQ(tracks.tracks().size(), 1u);
  EXPECT_EQ(tracks.tracks()[0].id, 1000);
}

TEST_F(ObjectTracksTest, FollowsNoMoreThanItMay) {
  config_.max_tracks = 1;
  ObjectTracks tracks = Make();
  tracks.Propose(kBox, Picture(0));
  tracks.Propose(kElsewhere, Picture(0));
  EXPECT_EQ(tracks.tracks().size(), 1u);
}

TEST_F(ObjectTracksTest, SmoothsTheBoxButJumpsAfterALongMiss) {
  ObjectTracks tracks = Confirmed();
  tracks.Hit(tracks.tracks()[0], {110, 100, 40, 40}, Picture(3));
  EXPECT_NEAR(tracks.tracks()[0].box.x_px, 105.0, 1e-9);
  for (int i = 0; i < 5; ++i) tracks.Miss(tracks.tracks()[0]);
  tracks.Hit(tracks.tracks()[0], {130, 100, 40, 40}, Picture(9));
  EXPECT_NEAR(tracks.tracks()[0].box.x_px, 130.0, 1e-9);
}

TEST_F(ObjectTracksTest, ScoresTheShareOfPicturesThatShowedIt) {
  ObjectTracks tracks = Confirmed();
  EXPECT_NEAR(tracks.tracks()[0].score, 1.0, 1e-9);
  tracks.Miss(tracks.tracks()[0]);
  EXPECT_LT(tracks.tracks()[0].score, 1.0);
  EXPECT_GT(tracks.tracks()[0].score, 0.0);
}

}  // namespace
}  // namespace deixis::object_detector
