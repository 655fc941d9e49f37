#include "services/pose_fitter/core/people/person_tracks.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>

#include "common/filtering/random.h"

namespace deixis::pose_fitter {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

/// Three in a row make somebody.
PersonTracksConfig ThreeFrames() {
  PersonTracksConfig config;
  config.frames_to_start = 3;
  return config;
}

PersonSighting At(double x_m, double z_m) { return {{x_m, 0.0, z_m}}; }

TEST(CheapestPairs, AgreesWithTryingAllOrders) {
  const filtering::CounterRandom random(3, 4);
  std::uint64_t counter = 0;
  for (int trial = 0; trial < 200; ++trial) {
    constexpr int kRows = 4, kColumns = 6;
    std::vector<double> costs(kRows * kColumns);
    for (double& cost : costs) cost = static_cast<double>(random.Uniform(counter++));
    const auto cost_of = [&](const std::vector<int>& pairs) {
      double sum = 0.0;
      for (int row = 0; row < kRows; ++row) {
        sum +=
            costs[static_cast<std::size_t>(row * kColumns + pairs[static_cast<std::size_t>(row)])];
      }
      return sum;
    };
    std::vector<int> order(kColumns);
    std::iota(order.begin(), order.end(), 0);
    double least = 1e9;
    do {
      least = std::min(least, cost_of(order));
    } while (std::next_permutation(order.begin(), order.end()));
    const auto pairs = CheapestPairs(costs, kRows, kColumns, 10.0);
    EXPECT_NEAR(cost_of(pairs), least, 1e-12);
  }
}

TEST(CheapestPairs, LeavesOutPairsThatMustNotBe) {
  EXPECT_THAT(CheapestPairs({9.0, 1.0, 9.0, 9.0}, 2, 2, 5.0), ElementsAre(1, -1));
}

TEST(PersonTracks, GivesANumberAfterSoManyFramesInARow) {
  PersonTracks tracks(ThreeFrames());
  EXPECT_THAT(tracks.Update({At(0, 2)}, 0.0), ElementsAre(-1));
  EXPECT_THAT(tracks.Update({At(0, 2)}, 0.1), ElementsAre(-1));
  EXPECT_THAT(tracks.Update({At(0, 2)}, 0.2), ElementsAre(0));
}

TEST(PersonTracks, GivesNoNumberToWhatFlickers) {
  PersonTracks tracks(ThreeFrames());
  for (int i = 0; i < 20; ++i) {
    const auto ids = i % 3 == 2 ? tracks.Update({}, 0.1 * i) : tracks.Update({At(0, 2)}, 0.1 * i);
    EXPECT_THAT(ids, Each(-1)) << i;
  }
}

TEST(PersonTracks, StartsNobodyFromADoubtfulSighting) {
  PersonTracks tracks(ThreeFrames());
  PersonSighting doubtful = At(0, 2);
  doubtful.may_start = false;
  for (int i = 0; i < 9; ++i) EXPECT_THAT(tracks.Update({doubtful}, 0.1 * i), ElementsAre(-1));
}

/// Two walk past each other, one metre per second each, half a metre apart in depth.
class Crossing : public ::testing::Test {
 protected:
  static PersonSighting Left(double t) { return At(-1.5 + t, 2.2); }
  static PersonSighting Right(double t) { return At(1.5 - t, 2.7); }
  PersonTracks tracks_{ThreeFrames()};
};

TEST_F(Crossing, KeepsBothNumbers) {
  for (int i = 0; i <= 90; ++i) {
    const double t = i / 30.0;
    // The order of sightings must not matter.
    const auto ids = i % 2 == 0 ? tracks_.Update({Left(t), Right(t)}, t)
                                : tracks_.Update({Right(t), Left(t)}, t);
    if (i < 3) continue;
    if (i % 2 == 0) {
      EXPECT_THAT(ids, ElementsAre(0, 1)) << i;
    } else {
      EXPECT_THAT(ids, ElementsAre(1, 0)) << i;
    }
  }
}

TEST_F(Crossing, KeepsBothNumbersThoughOneIsHiddenMeanwhile) {
  for (int i = 0; i <= 90; ++i) {
    const double t = i / 30.0;
    const bool is_hidden = i > 38 && i < 53;
    const auto ids =
        is_hidden ? tracks_.Update({Left(t)}, t) : tracks_.Update({Left(t), Right(t)}, t);
    if (i < 3) continue;
    EXPECT_EQ(ids.front(), 0) << i;
    if (!is_hidden) {
      EXPECT_EQ(ids.back(), 1) << i;
    }
  }
}

TEST(PersonTracks, FindsSomebodyAgainWithinTwoSecondsAndNotLater) {
  for (const double gap_s : {1.9, 2.2}) {
    PersonTracks tracks(ThreeFrames());
    for (int i = 0; i < 5; ++i) tracks.Update({At(0, 2), At(2, 3)}, 0.1 * i);
    double t = 0.4;
    for (; t < 0.4 + gap_s; t += 0.1) tracks.Update({At(0, 2)}, t);
    const auto ids = tracks.Update({At(0, 2), At(2.2, 3)}, t);
    EXPECT_EQ(ids[1], gap_s < 2.0 ? 1 : -1) << gap_s;
  }
}

TEST(PersonTracks, GivesADistantNewcomerANewNumber) {
  PersonTracks tracks(ThreeFrames());
  for (int i = 0; i < 5; ++i) tracks.Update({At(0, 2)}, 0.1 * i);
  for (int i = 5; i < 8; ++i) tracks.Update({At(2, 2)}, 0.1 * i);
  EXPECT_THAT(tracks.Update({At(2, 2)}, 0.8), ElementsAre(1));
}

TEST(PersonTracks, TrustsAKnownPersonMoreThanPositions) {
  PersonTracks tracks(ThreeFrames());
  for (int i = 0; i < 5; ++i) tracks.Update({At(0, 2), At(0.4, 2)}, 0.1 * i);
  PersonSighting first = At(0.4, 2), second = At(0, 2);
  first.known_id = 0;
  second.known_id = 1;
  EXPECT_THAT(tracks.Update({first, second}, 0.5), ElementsAre(0, 1));
}

TEST(PersonTracks, ForgetsEverybodyWhenTimeStepsBack) {
  PersonTracks tracks(ThreeFrames());
  for (int i = 0; i < 5; ++i) tracks.Update({At(0, 2)}, 10.0 + 0.1 * i);
  EXPECT_THAT(tracks.Update({At(0, 2)}, 1.0), ElementsAre(-1));
  EXPECT_EQ(tracks.Find(0), nullptr);
  tracks.Update({At(0, 2)}, 1.1);
  EXPECT_THAT(tracks.Update({At(0, 2)}, 1.2), ElementsAre(1)) << "numbers are never given twice";
}

TEST(PersonTracks, EstimatesTheSpeed) {
  PersonTracks tracks(ThreeFrames());
  for (int i = 0; i <= 30; ++i) tracks.Update({At(0.03 * i, 2)}, i / 30.0);
  ASSERT_NE(tracks.Find(0), nullptr);
  EXPECT_NEAR(tracks.Find(0)->velocity_m_per_s.x(), 0.9, 0.05);
}

TEST(PersonTracks, TakesNoMoreThanItsMost) {
  PersonTracks tracks(ThreeFrames());
  std::vector<PersonSighting> crowd;
  for (int i = 0; i < 100; ++i) crowd.push_back(At(1.0 * i, 2));
  for (int i = 0; i < 5; ++i) tracks.Update(crowd, 0.1 * i);
  EXPECT_EQ(tracks.tracks().size(), static_cast<std::size_t>(PersonTracks::kMost));
}

}  // namespace
}  // namespace deixis::pose_fitter
