#include "services/hand_tracker/core/hand_tracker.h"

#include <gtest/gtest.h>

#include <opencv2/core/utility.hpp>

#include "test/services/hand_tracker/core/synthetic_person.h"

namespace deixis::hand_tracker {
namespace {

// The tracker looks for the palm, a little nearer to the wrist than the middle of an ellipse.
constexpr double kTolerance_px = 7.0;

enum class FaceNews { kInTime, kLate, kNever };

/// Runs frames [begin, end) and returns what was said of the last one.
scene::Hands Watch(HandTracker& tracker, const SyntheticPerson& person, int begin, int end,
                   FaceNews news = FaceNews::kInTime) {
  constexpr int kDelay = 6;
  scene::Hands hands;
  for (int frame = begin; frame < end; ++frame) {
    if (news == FaceNews::kInTime) tracker.UpdateFaces(person.Faces(frame));
    if (news == FaceNews::kLate && frame >= kDelay)
      tracker.UpdateFaces(person.Faces(frame - kDelay));
    hands = tracker.Track(person.Picture(frame));
  }
  return hands;
}

const scene::Hand* Nearest(const scene::Hands& hands, const Eigen::Vector2d& place) {
  const scene::Hand* nearest = nullptr;
  for (const scene::Hand& hand : hands.hands) {
    if (nearest == nullptr ||
        (hand.centre_px - place).norm() < (nearest->centre_px - place).norm()) {
      nearest = &hand;
    }
  }
  return nearest;
}

bool AreEqual(const scene::Hands& a, const scene::Hands& b) {
  if (a.hands.size() != b.hands.size()) return false;
  for (std::size_t i = 0; i < a.hands.size(); ++i) {
    const bool is_equal = a.hands[i].id == b.hands[i].id &&
                          a.hands[i].centre_px == b.hands[i].centre_px &&
                          a.hands[i].velocity_px_per_s == b.hands[i].velocity_px_per_s;
    if (!is_equal) return false;
  }
  return true;
}

TEST(HandTracker, FindsBothHandsAndNothingElse) {
  HandTracker tracker;
  const SyntheticPerson person;
  const scene::Hands hands = Watch(tracker, person, 0, 150);
  ASSERT_EQ(hands.hands.size(), 2U);
  EXPECT_LT((Nearest(hands, person.RightHand(149))->centre_px - person.RightHand(149)).norm(),
            kTolerance_px);
  EXPECT_LT((Nearest(hands, person.LeftHand(149))->centre_px - person.LeftHand(149)).norm(),
            kTolerance_px);
}

TEST(HandTracker, TellsSidePersonAndWhichHandActs) {
  HandTracker tracker;
  const SyntheticPerson person;
  const scene::Hands hands = Watch(tracker, person, 0, 150);
  const scene::Hand& right = *Nearest(hands, person.RightHand(149));
  const scene::Hand& left = *Nearest(hands, person.LeftHand(149));
  EXPECT_EQ(right.side, scene::Side::kRight);
  EXPECT_EQ(left.side, scene::Side::kLeft);
  EXPECT_GT(right.side_probability, 0.9);
  EXPECT_EQ(right.person_id, 7);
  EXPECT_TRUE(right.is_acting);
  EXPECT_FALSE(left.is_acting);
}

TEST(HandTracker, KeepsTheIdentityOfAMovingHand) {
  HandTracker tracker;
  const SyntheticPerson person;
  const int id = Nearest(Watch(tracker, person, 0, 90), person.RightHand(89))->id;
  for (int frame = 90; frame < 240; ++frame) {
    const scene::Hands hands = Watch(tracker, person, frame, frame + 1);
    EXPECT_EQ(Nearest(hands, person.RightHand(frame))->id, id) << "frame " << frame;
  }
}

TEST(HandTracker, VelocityHasNoLag) {
  HandTracker tracker;
  const SyntheticPerson person;
  Watch(tracker, person, 0, 120);
  for (int frame = 120; frame < 180; ++frame) {
    const scene::Hands hands = Watch(tracker, person, frame, frame + 1);
    const Eigen::Vector2d velocity = (person.RightHand(frame + 1) - person.RightHand(frame - 1)) /
                                     (2.0 * SyntheticPerson::kPeriod_s);
    const scene::Hand& hand = *Nearest(hands, person.RightHand(frame));
    EXPECT_LT((hand.velocity_px_per_s - velocity).norm(), 60.0) << "frame " << frame;
  }
}

TEST(HandTracker, ManagesWithLateFaces) {
  HandTracker tracker;
  const SyntheticPerson person;
  const scene::Hands hands = Watch(tracker, person, 0, 150, FaceNews::kLate);
  ASSERT_FALSE(hands.hands.empty());
  EXPECT_LT((Nearest(hands, person.RightHand(149))->centre_px - person.RightHand(149)).norm(), 6.0);
}

TEST(HandTracker, ManagesWithoutAnyFace) {
  HandTracker tracker;
  const SyntheticPerson person;
  const scene::Hands hands = Watch(tracker, person, 0, 150, FaceNews::kNever);
  ASSERT_FALSE(hands.hands.empty());
  EXPECT_EQ(hands.hands[0].side, scene::Side::kUnknown);
  EXPECT_EQ(hands.hands[0].person_id, -1);
}

TEST(HandTracker, WorksAtOtherImageSizes) {
  for (const cv::Size size : {cv::Size(320, 240), cv::Size(1280, 960), cv::Size(500, 375)}) {
    HandTracker tracker;
    const SyntheticPerson person(size);
    const scene::Hands hands = Watch(tracker, person, 0, 120);
    const double scale = size.width / 640.0;
    const Eigen::Vector2d place = scale * person.RightHand(119);
    ASSERT_FALSE(hands.hands.empty()) << size;
    EXPECT_LT((Nearest(hands, place)->centre_px - place).norm(), 6.0 * scale) << size;
  }
}

TEST(HandTracker, StartsAnewWhenTimeGoesBackwards) {
  HandTracker tracker;
  const SyntheticPerson person;
  Watch(tracker, person, 0, 120);
  HandTracker fresh;
  for (int frame = 0; frame < 100; ++frame) {
    const scene::Hands again = Watch(tracker, person, frame, frame + 1);
    const scene::Hands first = Watch(fresh, person, frame, frame + 1);
    ASSERT_EQ(again.hands.size(), first.hands.size()) << "frame " << frame;
    for (std::size_t i = 0; i < again.hands.size(); ++i) {
      EXPECT_EQ(again.hands[i].centre_px, first.hands[i].centre_px);
    }
  }
}

TEST(HandTracker, IdsAreNeverUsedAgain) {
  HandTracker tracker;
  const SyntheticPerson person;
  int highest = 0;
  for (const scene::Hand& hand : Watch(tracker, person, 0, 120).hands) {
    highest = std::max(highest, hand.id);
  }
  for (const scene::Hand& hand : Watch(tracker, person, 0, 120).hands) EXPECT_GT(hand.id, highest);
}

TEST(HandTracker, SaysTheSameForAnyNumberOfThreads) {
  const SyntheticPerson person;
  const int before = cv::getNumThreads();
  HandTracker one;
  cv::setNumThreads(1);
  const scene::Hands with_one = Watch(one, person, 0, 90);
  HandTracker four;
  cv::setNumThreads(4);
  const scene::Hands with_four = Watch(four, person, 0, 90);
  cv::setNumThreads(before);
  EXPECT_TRUE(AreEqual(with_one, with_four));
}

TEST(HandTracker, NothingIsFoundWhereNothingMoves) {
  HandTracker tracker;
  const SyntheticPerson person;
  images::Image still = person.Picture(0);
  for (int frame = 0; frame < 200; ++frame) {
    still.time = SyntheticPerson::Time(frame);
    EXPECT_TRUE(tracker.Track(still).hands.empty());
  }
}

TEST(HandTracker, RepeatedFramesAndGapsDoNoHarm) {
  HandTracker tracker;
  const SyntheticPerson person;
  Watch(tracker, person, 0, 60);
  tracker.Track(person.Picture(60));
  tracker.Track(person.Picture(60));
  const scene::Hands hands = Watch(tracker, person, 75, 150);
  for (const scene::Hand& hand : hands.hands) {
    EXPECT_TRUE(hand.centre_px.allFinite());
    EXPECT_TRUE(hand.covariance.allFinite());
  }
  EXPECT_EQ(hands.hands.size(), 2U);
}

}  // namespace
}  // namespace deixis::hand_tracker
