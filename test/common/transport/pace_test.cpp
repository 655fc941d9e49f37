#include "common/transport/pace.h"

#include <gtest/gtest.h>

namespace deixis::transport {
namespace {

/// A hundred messages, each handled at once.
Pace Regular(double interval_ms, double work_ms) {
  Pace pace;
  for (int i = 0; i < 100; ++i) {
    pace.NoteArrival(static_cast<std::int64_t>(1e3 * interval_ms * i));
    pace.NoteWork(work_ms);
    pace.NoteCaughtUp();
  }
  return pace;
}

TEST(Pace, CatchesUpWithAFewWhenWorkIsQuick) {
  Pace pace = Regular(33.0, 8.0);
  int caught_up = 0;
  while (pace.CatchesUp()) ++caught_up;
  EXPECT_EQ(caught_up, 5);
  pace.NoteCaughtUp();
  EXPECT_TRUE(pace.CatchesUp());
}

TEST(Pace, DoesNotWhenWorkTakesMostOfTheTime) { EXPECT_FALSE(Regular(33.0, 20.0).CatchesUp()); }

TEST(Pace, DoesNotInAFlood) { EXPECT_FALSE(Regular(0.02, 0.05).CatchesUp()); }

TEST(Pace, DoesNotBeforeItIsKnown) {
  Pace pace;
  for (std::int64_t i = 0; i < 29; ++i) {
    EXPECT_FALSE(pace.CatchesUp());
    pace.NoteArrival(33'000 * i);
    pace.NoteWork(1.0);
  }
  EXPECT_FALSE(pace.CatchesUp());
}

TEST(Pace, SurvivesAClockThatIsSetBack) {
  Pace pace = Regular(33.0, 8.0);
  pace.NoteArrival(-1'000'000'000);
  EXPECT_TRUE(pace.CatchesUp());
}

}  // namespace
}  // namespace deixis::transport
