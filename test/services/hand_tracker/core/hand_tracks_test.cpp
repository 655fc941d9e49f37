#include "services/hand_tracker/core/hand_tracks.h"

#include <gtest/gtest.h>

#include <utility>

namespace deixis::hand_tracker {
namespace {

constexpr double kElapsed_s = 1.0 / 15.0;
constexpr double kHandLength_px = 40.0;

enum class Motion { kMoves, kKeepsStill };

// A region as large as a hand whose pixels changed of late; `motion` says whether they still do.
HandCandidate At(double x_px, double y_px, Motion motion) {
  HandCandidate candidate;
  candidate.centre = {x_px, y_px};
  candidate.tip = candidate.root = candidate.centre;
  candidate.box = {x_px - 10.0, y_px - 15.0, 20.0, 30.0};
  candidate.hand_length_px = kHandLength_px;
  candidate.area_px = 0.3 * kHandLength_px * kHandLength_px;
  candidate.region_length_px = kHandLength_px;
  candidate.moving_share = 1.0;
  candidate.fresh_share = motion == Motion::kMoves ? 1.0 : 0.0;
  return candidate;
}

class HandTracksTest : public testing::Test {
 protected:
  void See(std::vector<HandCandidate> candidates) {
    tracks_.Update({std::move(candidates), {}, kElapsed_s});
  }
  // A hand that sways at (100, 200) until it counts as one.
  void ConfirmOne() {
    for (int i = 0; i < 15; ++i) See({At(100.0 + i % 2, 200.0, Motion::kMoves)});
  }
  // The only confirmed track.
  const HandTrack& TheHand() const {
    const HandTrack* hand = nullptr;
    for (const HandTrack& track : tracks_.tracks()) {
      if (!track.is_confirmed()) continue;
      EXPECT_EQ(hand, nullptr) << "more than one hand";
      hand = &track;
    }
    if (hand == nullptr) throw std::logic_error("no hand");
    return *hand;
  }
  HandTracks tracks_{HandTracksConfig{}};
};

TEST_F(HandTracksTest, FollowsTheHandRatherThanWhatItUncovered) {
  ConfirmOne();
  See({At(110.0, 195.0, Motion::kMoves)});
  See({At(104.0, 200.0, Motion::kKeepsStill), At(128.0, 185.0, Motion::kMoves)});
  EXPECT_NEAR(TheHand().centre().x(), 128.0, 4.0);
}

TEST_F(HandTracksTest, FindsAHandAgainThatOutranItsTrack) {
  ConfirmOne();
  const int id = TheHand().id();
  // Its place is uncovered and keeps still while something moves farther than a track can follow.
  See({At(100.0, 200.0, Motion::kKeepsStill), At(175.0, 140.0, Motion::kMoves)});
  See({At(100.0, 200.0, Motion::kKeepsStill), At(190.0, 130.0, Motion::kMoves)});
  EXPECT_EQ(TheHand().id(), id);
  EXPECT_NEAR(TheHand().centre().x(), 190.0, 6.0);
}

TEST_F(HandTracksTest, FindsALostHandAgainUnderItsId) {
  ConfirmOne();
  const int id = TheHand().id();
  See({});
  See({At(160.0, 150.0, Motion::kMoves)});
  See({At(170.0, 145.0, Motion::kMoves)});
  EXPECT_EQ(TheHand().id(), id);
  EXPECT_NEAR(TheHand().centre().x(), 170.0, 6.0);
}

TEST_F(HandTracksTest, OnlyWhatMovesIsTakenForALostHandFarAway) {
  for (const Motion motion : {Motion::kMoves, Motion::kKeepsStill}) {
    tracks_.Reset();
    ConfirmOne();
    See({});
    See({});
    See({At(250.0, 120.0, motion)});
    See({At(255.0, 118.0, motion)});
    const bool is_taken = TheHand().centre().x() > 200.0;
    EXPECT_EQ(is_taken, motion == Motion::kMoves);
  }
}

TEST_F(HandTracksTest, ARestingHandStaysWhenAnotherMovesFarFromIt) {
  ConfirmOne();
  for (int i = 0; i < 12; ++i) See({At(100.0, 200.0, Motion::kKeepsStill)});
  const int id = TheHand().id();
  for (int i = 0; i < 2; ++i) {
    See({At(100.0, 200.0, Motion::kKeepsStill), At(200.0 + 10.0 * i, 100.0, Motion::kMoves)});
  }
  EXPECT_EQ(TheHand().id(), id);
  EXPECT_NEAR(TheHand().centre().x(), 100.0, 3.0);
}

}  // namespace
}  // namespace deixis::hand_tracker
