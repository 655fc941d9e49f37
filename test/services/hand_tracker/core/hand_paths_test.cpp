#include "services/hand_tracker/core/hand_paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "test/services/hand_tracker/core/made_candidate.h"

namespace deixis::hand_tracker {
namespace {

constexpr double kImage_s = 1.0 / 15.0;

enum class Motion { kMoves, kSways, kKeepsStill };

// A region as large as a hand. Of what moves all pixels changed since the last image; of what sways
// only of late.
HandCandidate At(double x_px, double y_px, Motion motion) {
  return MadeCandidate({x_px, y_px}, motion == Motion::kKeepsStill ? 0.0 : 1.0,
                       motion == Motion::kMoves ? 1.0 : 0.0);
}

// Face at (200, 100): shoulders at (165, 141) and (235, 141).
Person Somebody() {
  Person person;
  person.key = 0;
  person.face = {180.0, 80.0, kMadeHandLength_px, kMadeHandLength_px};
  return person;
}

HandCandidate Of(const Person& person, HandCandidate candidate) {
  const auto shoulders = Shoulders(person);
  const double right = (candidate.centre - shoulders[0]).norm();
  const double left = (candidate.centre - shoulders[1]).norm();
  candidate.shoulder = right < left ? 0 : 1;
  candidate.shoulder_distance_px = candidate.root_distance_px = std::min(right, left);
  return candidate;
}

class HandPathsTest : public testing::Test {
 protected:
  void See(std::vector<HandCandidate> candidates) {
    for (HandCandidate& candidate : candidates) candidate = Of(person_, candidate);
    paths_.Update(candidates, &person_, kImage_s);
  }
  // Two hands that hang down and sway.
  void Settle() {
    for (int i = 0; i < 15; ++i) See(Hanging());
  }
  static std::vector<HandCandidate> Hanging() {
    return {At(150.0, 260.0, Motion::kSways), At(250.0, 260.0, Motion::kSways)};
  }
  const HandGuess& right() const { return paths_.hands()[0]; }
  const HandGuess& left() const { return paths_.hands()[1]; }

  Person person_ = Somebody();
  HandPaths paths_{HandPathsConfig{}};
};

bool IsSeenAt(const HandGuess& hand, double x_px, double y_px) {
  return hand.candidate >= 0 && (hand.sight.position - Eigen::Vector2d(x_px, y_px)).norm() < 1.0;
}

TEST_F(HandPathsTest, KnowsNoHandsBeforeAnyImage) {
  EXPECT_EQ(right().kind, HandGuess::Kind::kAbsent);
}

TEST_F(HandPathsTest, FindsBothHandsOnTheirSides) {
  Settle();
  EXPECT_TRUE(IsSeenAt(right(), 150.0, 260.0));
  EXPECT_TRUE(IsSeenAt(left(), 250.0, 260.0));
}

TEST_F(HandPathsTest, TakesNothingForAHandThatNeverMoves) {
  for (int i = 0; i < 60; ++i) See({At(150.0, 260.0, Motion::kKeepsStill)});
  EXPECT_EQ(right().kind, HandGuess::Kind::kAbsent);
  EXPECT_EQ(left().kind, HandGuess::Kind::kAbsent);
}

TEST_F(HandPathsTest, GivesUpAThingThatStoodStillForLong) {
  Settle();
  for (int i = 0; i < 75; ++i)
    See({At(150.0, 260.0, Motion::kKeepsStill), At(250.0, 260.0, Motion::kSways)});
  EXPECT_TRUE(IsSeenAt(right(), 150.0, 260.0)) << "a hand may rest for a while";
  for (int i = 0; i < 150; ++i) {
    See({At(150.0, 260.0, Motion::kKeepsStill), At(250.0, 260.0, Motion::kSways)});
  }
  EXPECT_EQ(right().kind, HandGuess::Kind::kAbsent);
  EXPECT_TRUE(IsSeenAt(left(), 250.0, 260.0));
}

// What a hand uncovers may have its colour, and looks for a while as if it had just moved.
TEST_F(HandPathsTest, FollowsAFastHandRatherThanWhatItUncovered) {
  Settle();
  const double way[][2] = {{140.0, 240.0}, {110.0, 200.0}, {70.0, 160.0}, {50.0, 150.0}};
  for (const auto& place : way) {
    std::vector<HandCandidate> seen = Hanging();
    seen.push_back(At(place[0], place[1], Motion::kMoves));
    See(seen);
  }
  for (int i = 0; i < 6; ++i) {
    std::vector<HandCandidate> seen = Hanging();
    seen.push_back(At(50.0, 150.0, Motion::kSways));
    See(seen);
  }
  EXPECT_TRUE(IsSeenAt(right(), 50.0, 150.0));
  EXPECT_TRUE(IsSeenAt(left(), 250.0, 260.0));
}

TEST_F(HandPathsTest, LeavesNoHandThatIsSeenForSomethingThatPassesFarAway) {
  Settle();
  for (int i = 0; i < 3; ++i) {
    std::vector<HandCandidate> seen = Hanging();
    seen.push_back(At(40.0 + 8.0 * i, 60.0, Motion::kMoves));
    See(seen);
    EXPECT_TRUE(IsSeenAt(right(), 150.0, 260.0)) << i;
  }
}

TEST_F(HandPathsTest, FindsAHandThatWasUnseenInMidStroke) {
  Settle();
  const HandCandidate other = At(250.0, 260.0, Motion::kSways);
  See({At(140.0, 240.0, Motion::kMoves), other});
  See({At(115.0, 205.0, Motion::kMoves), other});
  See({other});
  EXPECT_EQ(right().kind, HandGuess::Kind::kUnseen);
  See({At(70.0, 150.0, Motion::kMoves), other});
  EXPECT_TRUE(IsSeenAt(right(), 70.0, 150.0));
  EXPECT_NEAR(right().sight.elapsed_s, 0.0, 1e-12);
}

TEST_F(HandPathsTest, SaysHowLongAHandIsUnseenThenForgetsIt) {
  Settle();
  const HandCandidate other = At(250.0, 260.0, Motion::kSways);
  for (int i = 0; i < 3; ++i) See({other});
  EXPECT_EQ(right().kind, HandGuess::Kind::kUnseen);
  EXPECT_NEAR(right().sight.elapsed_s, 3.0 * kImage_s, 1e-9);
  for (int i = 0; i < 30; ++i) See({other});
  EXPECT_EQ(right().kind, HandGuess::Kind::kAbsent);
}

TEST_F(HandPathsTest, TakesTwoHandsInOneLumpForBoth) {
  Settle();
  for (int i = 1; i <= 9; ++i) {
    See({At(150.0 + 5.0 * i, 260.0, Motion::kMoves), At(250.0 - 5.0 * i, 260.0, Motion::kMoves)});
  }
  for (int i = 0; i < 8; ++i) See({At(200.0, 260.0, Motion::kSways)});
  EXPECT_TRUE(IsSeenAt(right(), 200.0, 260.0));
  EXPECT_TRUE(IsSeenAt(left(), 200.0, 260.0));
}

TEST_F(HandPathsTest, LeavesOutOfReachWhatIsOutOfReach) {
  for (int i = 0; i < 30; ++i) See({At(150.0, 380.0, Motion::kSways)});
  EXPECT_EQ(right().kind, HandGuess::Kind::kAbsent);
}

TEST_F(HandPathsTest, ForgetsNoHandWhenTwoImagesHaveOneTime) {
  Settle();
  std::vector<HandCandidate> seen = Hanging();
  for (HandCandidate& candidate : seen) candidate = Of(person_, candidate);
  paths_.Update(seen, &person_, 0.0);
  EXPECT_TRUE(IsSeenAt(right(), 150.0, 260.0));
  EXPECT_TRUE(std::isfinite(right().sight.velocity.norm()));
}

TEST_F(HandPathsTest, BearsMoreCandidatesThanItLooksAt) {
  Settle();
  std::vector<HandCandidate> seen = Hanging();
  for (int i = 0; i < 200; ++i) seen.push_back(At(3.0 * i, 50.0, Motion::kKeepsStill));
  See(seen);
  EXPECT_TRUE(IsSeenAt(right(), 150.0, 260.0));
  EXPECT_TRUE(IsSeenAt(left(), 250.0, 260.0));
}

TEST(HandPathsOfNobody, TakesTheEndsOfOneRegionForOneHand) {
  HandPaths paths{HandPathsConfig{}};
  HandCandidate one = At(100.0, 100.0, Motion::kMoves);
  HandCandidate other = At(180.0, 100.0, Motion::kMoves);
  one.region = other.region = 0;
  for (int i = 0; i < 15; ++i) paths.Update({one, other}, nullptr, kImage_s);
  const auto& [right, left] = paths.hands();
  EXPECT_NE(right.candidate >= 0, left.candidate >= 0);
}

}  // namespace
}  // namespace deixis::hand_tracker
