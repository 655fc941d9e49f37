#include "common/capture/pacer.h"

#include <gtest/gtest.h>

namespace deixis::capture {
namespace {

constexpr Timestamp kStart{1'000'000'000};

Timestamp After(std::int64_t us) { return {kStart.microseconds + us}; }

TEST(Pacer, LetsPicturesBeDueAsTheirTimesSay) {
  Pacer pacer(Pace::kByTime, -1);
  EXPECT_TRUE(pacer.IsDue({0}, kStart));
  EXPECT_FALSE(pacer.IsDue({100'000}, After(99'999)));
  EXPECT_TRUE(pacer.IsDue({100'000}, After(100'000)));
}

TEST(Pacer, MapsTimesOntoTheWallClockOnceAtTheStart) {
  Pacer pacer(Pace::kByTime, -1);
  pacer.IsDue({0}, kStart);
  pacer.IsDue({100'000}, After(5'000'000));  // Played late: times stay those of the recording.
  EXPECT_EQ(pacer.CaptureTime({100'000}).microseconds, After(100'000).microseconds);
}

TEST(Pacer, SaysThatItPlaysMoreThanASecondLateAsLongAsItDoes) {
  Pacer pacer(Pace::kByTime, -1);
  pacer.IsDue({0}, kStart);
  pacer.IsDue({100'000}, After(1'100'000));
  EXPECT_EQ(pacer.trouble(), "");
  pacer.IsDue({200'000}, After(3'900'000));
  EXPECT_EQ(pacer.trouble(), "plays 3 s late: this machine is too slow for the recording's rate");
  pacer.IsDue({4'000'000}, After(3'950'000));
  EXPECT_EQ(pacer.trouble(), "");
}

TEST(Pacer, TakesAStartTimeThatIsGiven) {
  Pacer pacer(Pace::kByTime, 42);
  pacer.IsDue({0}, kStart);
  EXPECT_EQ(pacer.CaptureTime({100'000}).microseconds, 100'042);
}

TEST(Pacer, DoesNotWaitNorLookAtTheClockWhenAsFastAsPossible) {
  Pacer pacer(Pace::kAsFastAsPossible, -1);
  EXPECT_TRUE(pacer.IsDue({0}, kStart));
  EXPECT_TRUE(pacer.IsDue({100'000'000}, kStart));
  EXPECT_TRUE(pacer.IsDue({100'033'000}, After(500'000'000)));
  EXPECT_EQ(pacer.trouble(), "");
  EXPECT_EQ(pacer.CaptureTime({100'000}).microseconds, 100'000);
}

}  // namespace
}  // namespace deixis::capture
