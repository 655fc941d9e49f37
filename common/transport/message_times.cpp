#include "common/transport/message_times.h"

namespace deixis::transport {
namespace {

constexpr double kBack_s = 1.0;
constexpr double kAhead_s = 3600.0;
constexpr std::chrono::seconds kMemory{10};

}  // namespace

bool MessageTimes::Jumps(Timestamp time, Clock::time_point now) {
  const double step_s = last_ ? SecondsBetween(*last_, time) : 0.0;
  const double passed_s = std::chrono::duration<double>(now - heard_).count();
  const bool jumps = last_ && (step_s < -kBack_s || step_s - passed_s > kAhead_s);
  last_ = time;
  heard_ = now;
  if (!jumps) return false;
  ++jumps_;
  last_jump_s_ = step_s;
  jumped_ = now;
  return true;
}

bool MessageTimes::HasJumped(Clock::time_point now) const {
  return jumps_ > 0 && now - jumped_ <= kMemory;
}

}  // namespace deixis::transport
