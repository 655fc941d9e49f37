#pragma once
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/time/timestamp.h"

namespace deixis::transport {

/// Follows the sequence numbers of one channel: what is missing, and whether two publishers count
/// on it at the same time.
///
/// Two publishers show by their numbers going back and forth between two counts, or, when the
/// counts are close, by numbers that come twice with different times. A publisher that starts anew
/// jumps once and never returns; a datagram that was overtaken comes late but never twice. So
/// neither is taken for a second publisher, nor is one that leaves its numbers at 0.
class PublisherSequences {
 public:
  using Clock = std::chrono::steady_clock;

  /// Takes the next message. `sequence` is -1 (none) or 0..2^60; `skipped` messages were received
  /// and passed over since the one before.
  void Observe(std::int64_t sequence, Timestamp time, std::int64_t skipped, Clock::time_point now);

  /// Messages that are missing between the numbers of one publisher.
  std::int64_t gaps() const { return gaps_; }
  /// Messages that showed a second publisher, since the start.
  std::int64_t out_of_turn() const { return out_of_turn_; }
  /// Whether a second publisher has shown several times of late.
  bool HasTwoPublishers(Clock::time_point now) const;

 private:
  /// One count that messages may go on from.
  struct Count {
    std::int64_t last = 0;
    std::int64_t missing = 0;  ///< Between it and the count before: counted as gaps.
    Clock::time_point heard{};
  };
  struct Seen {
    std::int64_t sequence = -1;
    Timestamp time;
  };

  void Forget(Clock::time_point now);
  bool IsRepeated(std::int64_t sequence) const;
  bool IsOfAnotherTime(std::int64_t sequence, Timestamp time) const;
  std::optional<std::size_t> CountBefore(std::int64_t sequence) const;
  void Continue(std::int64_t sequence, std::int64_t skipped);
  void ReturnTo(std::size_t count, std::int64_t sequence, Clock::time_point now);
  void Begin(std::int64_t sequence, std::int64_t missing);
  void NoteSecondPublisher(Clock::time_point now);
  void Remember(std::int64_t sequence, Timestamp time, Clock::time_point now);

  std::vector<Count> counts_;  ///< The current one last.
  std::array<Seen, 32> seen_{};
  std::size_t next_seen_ = 0;
  std::array<Clock::time_point, 3> signs_{};  ///< Of a second publisher, the oldest first.
  std::int64_t gaps_ = 0;
  std::int64_t out_of_turn_ = 0;
};

}  // namespace deixis::transport
