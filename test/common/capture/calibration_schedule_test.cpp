#include "common/capture/calibration_schedule.h"

#include <gtest/gtest.h>

namespace deixis::capture {
namespace {

TEST(CalibrationSchedule, IsDueAtFirstAndThenOncePerSecond) {
  CalibrationSchedule schedule;
  EXPECT_TRUE(schedule.IsDue({7}));
  schedule.NoteSent({7});
  EXPECT_FALSE(schedule.IsDue({7}));
  EXPECT_FALSE(schedule.IsDue({1'000'006}));
  EXPECT_TRUE(schedule.IsDue({1'000'007}));
}

TEST(CalibrationSchedule, AClockThatIsSetBackDoesNotSilenceIt) {
  CalibrationSchedule schedule;
  schedule.NoteSent({3'600'000'000});
  EXPECT_TRUE(schedule.IsDue({5}));
}

TEST(CalibrationSchedule, IsDueAtOnceWhenItBeginsAnew) {
  CalibrationSchedule schedule;
  schedule.NoteSent({7});
  schedule.BeginAnew();
  EXPECT_TRUE(schedule.IsDue({8}));
}

}  // namespace
}  // namespace deixis::capture
