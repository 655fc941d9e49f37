#include "common/transport/message_times.h"

#include <gtest/gtest.h>

namespace deixis::transport {
namespace {

constexpr std::int64_t kHour_us = 3'600'000'000;

class MessageTimesTest : public testing::Test {
 protected:
  bool Jumps(std::int64_t time_us) {
    now_ += std::chrono::milliseconds{33};
    return times_.Jumps({time_us}, now_);
  }
  MessageTimes times_;
  MessageTimes::Clock::time_point now_{std::chrono::hours{1}};
};

TEST_F(MessageTimesTest, TakesAFastReplayWithPausesForNoJump) {
  for (std::int64_t i = 0; i < 10; ++i) EXPECT_FALSE(Jumps(i * 60'000'000));
  EXPECT_FALSE(times_.HasJumped(now_));
}

TEST_F(MessageTimesTest, TakesALittleDisorderForNoJump) {
  for (const std::int64_t time : {9'000'000, 9'500'000, 9'200'000}) EXPECT_FALSE(Jumps(time));
}

TEST_F(MessageTimesTest, TakesAChannelThatWasSilentForHoursForNoJump) {
  EXPECT_FALSE(Jumps(0));
  now_ += std::chrono::hours{5};
  EXPECT_FALSE(Jumps(5 * kHour_us));
}

TEST_F(MessageTimesTest, CountsJumpsBackAndAheadAndForgetsThem) {
  EXPECT_FALSE(Jumps(5 * kHour_us));
  EXPECT_TRUE(Jumps(7 * kHour_us));
  EXPECT_TRUE(Jumps(2 * kHour_us));
  EXPECT_TRUE(Jumps(std::int64_t{1} << 60));
  EXPECT_TRUE(Jumps(2 * kHour_us));
  EXPECT_EQ(times_.jumps(), 4);
  EXPECT_LT(times_.last_jump_s(), -1e9);
  EXPECT_TRUE(times_.HasJumped(now_));
  EXPECT_FALSE(times_.HasJumped(now_ + std::chrono::seconds{11}));
}

}  // namespace
}  // namespace deixis::transport
