#pragma once
#include <algorithm>
#include <cstdint>

namespace deixis::transport {

/// Whether a handler can catch up with messages that wait since it, or the machine, was held up for
/// a moment: when its work takes less than half of the time between two of them, and only a few
/// wait. Else those that wait would only make the newest later.
class Pace {
 public:
  /// A message came at that time, microseconds of any clock.
  void NoteArrival(std::int64_t time_us) {
    if (has_arrived_) Follow(interval_ms_, 1e-3 * static_cast<double>(time_us - last_us_));
    has_arrived_ = true;
    last_us_ = time_us;
  }
  void NoteWork(double work_ms) {
    Follow(work_ms_, work_ms);
    ++handled_;
  }

  /// Asked when a message waits while the next one is there; true = it is handled, too.
  bool CatchesUp() {
    const bool is_quick = handled_ >= kLeastHandled && 2.0 * work_ms_ < interval_ms_;
    return is_quick && caught_up_++ < kMostInARow;
  }
  /// Nothing waits any more.
  void NoteCaughtUp() { caught_up_ = 0; }

 private:
  static constexpr int kMostInARow = 5;
  static constexpr std::int64_t kLeastHandled = 30;  // Till then the pace is not known.
  static constexpr double kShare = 0.1;              // Of a new value in the mean.
  static constexpr double kLongest_ms = 1000.0;

  static void Follow(double& mean_ms, double value_ms) {
    const double bounded_ms = std::clamp(value_ms, 0.0, kLongest_ms);
    mean_ms = mean_ms < 0.0 ? bounded_ms : mean_ms + kShare * (bounded_ms - mean_ms);
  }

  bool has_arrived_ = false;
  std::int64_t last_us_ = 0;
  double interval_ms_ = -1.0;
  double work_ms_ = -1.0;
  std::int64_t handled_ = 0;
  int caught_up_ = 0;
};

}  // namespace deixis::transport
