#pragma once
#include <chrono>
#include <cstdint>
#include <optional>

#include "common/time/timestamp.h"

namespace deixis::transport {

/// Watches the times of one channel's messages for jumps: more than a second back, or an hour more
/// ahead than has passed. A clock was set, a log is played again, or a camera is wrong.
class MessageTimes {
 public:
  using Clock = std::chrono::steady_clock;

  /// Takes the next message's time; true when it is a jump.
  bool Jumps(Timestamp time, Clock::time_point now);

  std::int64_t jumps() const { return jumps_; }        ///< Since the start.
  double last_jump_s() const { return last_jump_s_; }  ///< Negative: back.
  bool HasJumped(Clock::time_point now) const;         ///< Within the last ten seconds.

 private:
  std::optional<Timestamp> last_;
  Clock::time_point heard_{};
  Clock::time_point jumped_{};
  std::int64_t jumps_ = 0;
  double last_jump_s_ = 0.0;
};

}  // namespace deixis::transport
