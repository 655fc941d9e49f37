#include "services/hand_tracker/core/hand_tracks.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

#include "test/services/hand_tracker/core/made_candidate.h"

namespace deixis::hand_tracker {
namespace {

constexpr double kElapsed_s = 1.0 / 15.0;

enum class Motion { kMoves, kSways };

// A region as large as a hand; of nobody unless `person` says whose.
HandCandidate At(double x_px, double y_px, Motion motion = Motion::kSways, int person = -1) {
  HandCandidate candidate = MadeCandidate({x_px, y_px}, 1.0, motion == Motion::kMoves ? 1.0 : 0.0);
  candidate.person = person;
  candidate.shoulder = person >= 0 ? 0 : -1;
  candidate.root_distance_px = candidate.shoulder_distance_px = 2.0 * kMadeHandLength_px;
  return candidate;
}

Person PersonAt(int key, double x_px) {
  Person person;
  person.key = key;
  person.face = {x_px - 20.0, 80.0, kMadeHandLength_px, kMadeHandLength_px};
  return person;
}

class HandTracksTest : public testing::Test {
 protected:
  void See(std::vector<HandCandidate> candidates, std::vector<Person> people = {}) {
    tracks_.Update({std::move(candidates), std::move(people), kElapsed_s});
  }
  void SeeForASecond(const std::vector<HandCandidate>& candidates,
                     const std::vector<Person>& people = {}) {
    for (int i = 0; i < 15; ++i) See(candidates, people);
  }
  const HandTrack& TheHand() const {
    if (tracks_.tracks().size() != 1) throw std::logic_error("not one hand");
    return tracks_.tracks().front();
  }
  HandTracks tracks_{HandTracksConfig{}};
};

TEST_F(HandTracksTest, FollowsAHandUnderItsId) {
  SeeForASecond({At(100.0, 200.0)});
  const int id = TheHand().id();
  for (int i = 1; i <= 5; ++i) See({At(100.0 + 15.0 * i, 200.0, Motion::kMoves)});
  EXPECT_EQ(TheHand().id(), id);
  EXPECT_NEAR(TheHand().centre().x(), 175.0, 6.0);
  EXPECT_EQ(TheHand().state(), scene::HandState::kMeasured);
}

TEST_F(HandTracksTest, SaysThatAHandIsNotSeen) {
  SeeForASecond({At(100.0, 200.0)});
  See({});
  EXPECT_EQ(TheHand().state(), scene::HandState::kPredicted);
  for (int i = 0; i < 6; ++i) See({});
  EXPECT_EQ(TheHand().state(), scene::HandState::kOccluded);
  EXPECT_NEAR(TheHand().unseen_s(), 7.0 * kElapsed_s, 1e-9);
}

TEST_F(HandTracksTest, TellsOfAHandNoMoreThatWasUnseenForLong) {
  SeeForASecond({At(100.0, 200.0)});
  for (int i = 0; i < 40; ++i) See({});
  EXPECT_TRUE(tracks_.tracks().empty());
}

TEST_F(HandTracksTest, NeverFollowsMoreThanTwoHandsOfOnePerson) {
  const std::vector<Person> people{PersonAt(3, 200.0)};
  SeeForASecond({At(150.0, 230.0, Motion::kSways, 0), At(250.0, 230.0, Motion::kSways, 0),
                 At(200.0, 280.0, Motion::kSways, 0)},
                people);
  EXPECT_EQ(tracks_.tracks().size(), 2U);
}

TEST_F(HandTracksTest, FollowsTheHandsOfEveryPerson) {
  const std::vector<Person> people{PersonAt(3, 100.0), PersonAt(4, 400.0)};
  SeeForASecond({At(60.0, 230.0, Motion::kSways, 0), At(140.0, 230.0, Motion::kSways, 0),
                 At(360.0, 230.0, Motion::kSways, 1), At(440.0, 230.0, Motion::kSways, 1)},
                people);
  EXPECT_EQ(tracks_.tracks().size(), 4U);
}

TEST_F(HandTracksTest, KeepsAHandWhenItsFaceIsFoundAndLost) {
  SeeForASecond({At(160.0, 230.0)});
  const int id = TheHand().id();
  SeeForASecond({At(160.0, 230.0, Motion::kSways, 0)}, {PersonAt(1, 200.0)});
  EXPECT_EQ(TheHand().id(), id);
  SeeForASecond({At(160.0, 230.0)});
  EXPECT_EQ(TheHand().id(), id);
}

TEST_F(HandTracksTest, ForgetsTheHandsOfWhoHasGone) {
  const std::vector<Person> both{PersonAt(3, 100.0), PersonAt(4, 400.0)};
  SeeForASecond({At(60.0, 230.0, Motion::kSways, 0), At(440.0, 230.0, Motion::kSways, 1)}, both);
  ASSERT_EQ(tracks_.tracks().size(), 2U);
  See({At(60.0, 230.0, Motion::kSways, 0)}, {PersonAt(3, 100.0)});
  EXPECT_NEAR(TheHand().centre().x(), 60.0, 3.0);
}

TEST_F(HandTracksTest, KnowsAHandInALumpWithTheOtherLessWell) {
  const std::vector<Person> people{PersonAt(3, 200.0)};
  SeeForASecond({At(150.0, 250.0, Motion::kSways, 0), At(250.0, 250.0, Motion::kSways, 0)}, people);
  ASSERT_EQ(tracks_.tracks().size(), 2U);
  const double alone = tracks_.tracks().front().Covariance()(0, 0);
  for (int i = 1; i <= 9; ++i) {
    See({At(150.0 + 5.0 * i, 250.0, Motion::kMoves, 0),
         At(250.0 - 5.0 * i, 250.0, Motion::kMoves, 0)},
        people);
  }
  for (int i = 0; i < 10; ++i) See({At(200.0, 250.0, Motion::kSways, 0)}, people);
  ASSERT_EQ(tracks_.tracks().size(), 2U);
  EXPECT_GT(tracks_.tracks().front().Covariance()(0, 0), 1.5 * alone);
}

}  // namespace
}  // namespace deixis::hand_tracker
