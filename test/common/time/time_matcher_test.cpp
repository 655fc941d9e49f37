#include "common/time/time_matcher.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace deixis {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class TimeMatcherTest : public testing::Test {
 protected:
  void First(std::int64_t ms) { matcher_.AddFirst({ms * 1000}, "a" + std::to_string(ms)); }
  void Second(std::int64_t ms) { matcher_.AddSecond({ms * 1000}, "b" + std::to_string(ms)); }
  std::vector<std::string> Matches() {
    std::vector<std::string> all;
    while (const auto match = matcher_.Next()) all.push_back(match->first + match->second);
    return all;
  }

  TimeMatcher<std::string, std::string> matcher_{0.010, 4};
};

TEST_F(TimeMatcherTest, PairsWhatWasTakenTogether) {
  First(0);
  Second(2);
  First(33);
  Second(34);
  EXPECT_THAT(Matches(), ElementsAre("a0b2", "a33b34"));
  EXPECT_EQ(matcher_.unmatched_first() + matcher_.unmatched_second(), 0);
}

TEST_F(TimeMatcherTest, DoesNotMindWhichStreamIsLate) {
  Second(0);
  Second(33);
  EXPECT_THAT(Matches(), IsEmpty());
  First(1);
  First(34);
  EXPECT_THAT(Matches(), ElementsAre("a1b0", "a34b33"));
}

TEST_F(TimeMatcherTest, CountsWhatHasNoPartner) {
  First(0);
  First(33);
  Second(33);
  First(66);
  Second(99);
  First(99);
  EXPECT_THAT(Matches(), ElementsAre("a33b33", "a99b99"));
  EXPECT_EQ(matcher_.unmatched_first(), 2);
  EXPECT_EQ(matcher_.unmatched_second(), 0);
}

TEST_F(TimeMatcherTest, PrefersTheNearerPartner) {
  First(0);
  First(9);
  Second(10);
  EXPECT_THAT(Matches(), ElementsAre("a9b10"));
  EXPECT_EQ(matcher_.unmatched_first(), 1);
}

TEST_F(TimeMatcherTest, PairsAtTheSkewAndNotBeyondIt) {
  First(0);
  Second(10);
  EXPECT_THAT(Matches(), ElementsAre("a0b10"));
  First(100);
  Second(111);
  Second(144);
  EXPECT_THAT(Matches(), IsEmpty());
  EXPECT_EQ(matcher_.unmatched_first(), 1);
}

TEST_F(TimeMatcherTest, WaitsWithNoMoreThanItsCapacityWhenTheOtherStreamIsSilent) {
  for (int i = 0; i < 10; ++i) First(33 * i);
  EXPECT_EQ(matcher_.unmatched_first(), 6);
  Second(33 * 9);
  EXPECT_THAT(Matches(), ElementsAre("a297b297"));
}

TEST_F(TimeMatcherTest, BeginsAnewWhenTwoTimesGoBackwards) {
  First(1'000'000);
  First(1'000'033);
  First(0);
  Second(0);
  EXPECT_THAT(Matches(), IsEmpty());
  First(33);
  EXPECT_THAT(Matches(), ElementsAre("a0b0"));
  EXPECT_EQ(matcher_.unmatched_first(), 2);
}

TEST_F(TimeMatcherTest, RecoversWhenBothStreamsGoBackwards) {
  First(1'000'000);
  Second(1'000'040);
  First(0);
  Second(1);
  EXPECT_THAT(Matches(), ElementsAre("a0b1"));
}

TEST_F(TimeMatcherTest, LosesNothingToOneTimeToCome) {
  First(0);
  Second(1'000'000);
  EXPECT_THAT(Matches(), IsEmpty());
  Second(1);
  EXPECT_THAT(Matches(), ElementsAre("a0b1"));
  First(33);
  First(1'000'000);
  First(66);
  Second(33);
  Second(66);
  EXPECT_THAT(Matches(), ElementsAre("a33b33", "a66b66"));
  EXPECT_EQ(matcher_.unmatched_first(), 1);
  EXPECT_EQ(matcher_.unmatched_second(), 1);
}

TEST_F(TimeMatcherTest, LosesNothingToOneTimeLongAgo) {
  First(1'000'000);
  Second(0);
  EXPECT_THAT(Matches(), IsEmpty());
  Second(1'000'001);
  EXPECT_THAT(Matches(), ElementsAre("a1000000b1000001"));
  EXPECT_EQ(matcher_.unmatched_second(), 1);
}

/// Ten items of either stream, one of the first with a damaged time, while one stream is late.
struct Damage {
  int damaged;
  std::int64_t says_ms;
  int first_is_late;
  int second_is_late;
};

class OneDamagedTime : public TimeMatcherTest, public testing::WithParamInterface<Damage> {};

TEST_P(OneDamagedTime, CostsItsOwnItemOnly) {
  const Damage& damage = GetParam();
  std::vector<std::string> matches;
  const auto note = [&] {
    for (std::string& match : Matches()) matches.push_back(std::move(match));
  };
  std::vector<std::string> expected;
  for (int i = 1; i <= 10; ++i) {
    const std::string time = std::to_string(33 * i);
    if (i != damage.damaged) expected.push_back("a" + time + "b" + time);
  }
  for (int i = 1; i <= 13; ++i) {
    const int first = i - damage.first_is_late, second = i - damage.second_is_late;
    if (first >= 1 && first <= 10) First(first == damage.damaged ? damage.says_ms : 33 * first);
    note();
    if (second >= 1 && second <= 10) Second(33 * second);
    note();
  }
  EXPECT_EQ(matches, expected);
  matcher_.Finish();
  EXPECT_EQ(matcher_.unmatched_first(), 1);
  EXPECT_EQ(matcher_.unmatched_second(), 1);
}

INSTANTIATE_TEST_SUITE_P(Anywhere, OneDamagedTime,
                         testing::Values(Damage{1, 1'000'000, 0, 0}, Damage{1, 1'000'000, 3, 0},
                                         Damage{1, 1'000'000, 0, 3}, Damage{5, 1'000'000, 0, 0},
                                         Damage{5, 1'000'000, 3, 0}, Damage{5, 1'000'000, 0, 3},
                                         Damage{10, 1'000'000, 0, 3}, Damage{5, 0, 0, 0},
                                         Damage{5, 0, 3, 0}, Damage{5, 0, 0, 3},
                                         Damage{10, 0, 3, 0}, Damage{3, 0, 0, 3}));

TEST_F(TimeMatcherTest, FollowsBothStreamsIntoAnotherTime) {
  First(0);
  Second(1'000'000);
  Second(1'000'033);
  First(1'000'034);
  EXPECT_THAT(Matches(), ElementsAre("a1000034b1000033"));
  EXPECT_EQ(matcher_.unmatched_first(), 1);
  EXPECT_EQ(matcher_.unmatched_second(), 1);
}

TEST_F(TimeMatcherTest, WantsOfEitherWhatMayMatch) {
  EXPECT_TRUE(matcher_.wants_first() && matcher_.wants_second());
  First(0);
  EXPECT_FALSE(matcher_.wants_first());
  EXPECT_TRUE(matcher_.wants_second());
  Second(50);
  EXPECT_THAT(Matches(), IsEmpty());
  EXPECT_TRUE(matcher_.wants_first() && matcher_.wants_second());
}

TEST_F(TimeMatcherTest, IsOverWhenNoMatchCanCome) {
  EXPECT_TRUE(matcher_.IsOver(/*first_ended=*/true, /*second_ended=*/false));
  First(0);
  EXPECT_FALSE(matcher_.IsOver(/*first_ended=*/true, /*second_ended=*/false));
  EXPECT_TRUE(matcher_.IsOver(/*first_ended=*/false, /*second_ended=*/true));
  Second(50);
  EXPECT_FALSE(matcher_.IsOver(/*first_ended=*/true, /*second_ended=*/false));
  EXPECT_TRUE(matcher_.IsOver(/*first_ended=*/true, /*second_ended=*/true));
}

TEST_F(TimeMatcherTest, CountsWhatIsLeftAtTheEnd) {
  First(0);
  Second(50);
  matcher_.Finish();
  EXPECT_EQ(matcher_.unmatched_first(), 1);
  EXPECT_EQ(matcher_.unmatched_second(), 1);
  EXPECT_FALSE(matcher_.Next());
}

}  // namespace
}  // namespace deixis
