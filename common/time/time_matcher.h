#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "common/time/timestamp.h"

namespace deixis {

/// Items of two streams that were taken together.
template <typename First, typename Second>
struct TimeMatch {
  Timestamp first_time;
  First first;
  Timestamp second_time;
  Second second;
};

/// Finds which items of two streams were taken together. Items may arrive in any order between the
/// streams; within a stream times must grow. An item goes out with the nearest one of the other
/// stream that is there and no further than the skew; so take a skew below half the period. What
/// can find no partner any more is dropped and counted: a nearer one of its own stream came, or two
/// of the other stream lie beyond it. One does not count, its time may be damaged. Time that goes
/// backwards in a stream begins anew there: what waits and is not earlier is dropped and counted.
template <typename First, typename Second>
class TimeMatcher {
 public:
  using Match = TimeMatch<First, Second>;

  /// Waits with at most `capacity` items per stream: the oldest go when the other stream is silent.
  explicit TimeMatcher(double max_skew_s, std::size_t capacity = 30)
      : max_skew_s_(max_skew_s), capacity_(capacity) {}

  void AddFirst(Timestamp time, First item) {
    Add(time, std::move(item), firsts_, unmatched_first_);
  }
  void AddSecond(Timestamp time, Second item) {
    Add(time, std::move(item), seconds_, unmatched_second_);
  }

  /// The next match, in the order of time; call until there is none.
  std::optional<Match> Next() {
    while (!firsts_.empty() && !seconds_.empty()) {
      const double skew_s = SecondsBetween(firsts_.front().time, seconds_.front().time);
      const bool first_is_late = skew_s<-max_skew_s_, second_is_late = skew_s> max_skew_s_;
      if (HasNearer(seconds_, firsts_.front().time, std::abs(skew_s)) ||
          (first_is_late && firsts_.size() > 1)) {
        Drop(seconds_, unmatched_second_);
      } else if (HasNearer(firsts_, seconds_.front().time, std::abs(skew_s)) ||
                 (second_is_late && seconds_.size() > 1)) {
        Drop(firsts_, unmatched_first_);
      } else if (first_is_late || second_is_late) {
        return std::nullopt;
      } else {
        return TakeFronts();
      }
    }
    return std::nullopt;
  }

  /// Drops and counts what waits: the streams have ended.
  void Finish() {
    while (!firsts_.empty()) Drop(firsts_, unmatched_first_);
    while (!seconds_.empty()) Drop(seconds_, unmatched_second_);
  }

  /// Whether, when Next() found none, one more of that stream may bring a match.
  bool wants_first() const { return firsts_.empty() || !seconds_.empty(); }
  bool wants_second() const { return seconds_.empty() || !firsts_.empty(); }
  /// Whether, when Next() found none, nothing can match any more because streams have ended.
  bool IsOver(bool first_ended, bool second_ended) const {
    return (first_ended && second_ended) || (first_ended && firsts_.empty()) ||
           (second_ended && seconds_.empty());
  }
  std::int64_t unmatched_first() const { return unmatched_first_; }
  std::int64_t unmatched_second() const { return unmatched_second_; }

 private:
  template <typename T>
  struct Timed {
    Timestamp time;
    T item;
  };
  template <typename T>
  using Queue = std::deque<Timed<T>>;

  template <typename T>
  static void Drop(Queue<T>& queue, std::int64_t& count) {
    queue.pop_front();
    ++count;
  }

  template <typename T>
  void Add(Timestamp time, T item, Queue<T>& queue, std::int64_t& unmatched) {
    for (; !queue.empty() && !(queue.back().time < time); ++unmatched) queue.pop_back();
    while (queue.size() >= capacity_) Drop(queue, unmatched);
    queue.push_back({time, std::move(item)});
  }

  /// Whether the item behind the front of `queue` is nearer to `time` than the front is.
  template <typename T>
  static bool HasNearer(const Queue<T>& queue, Timestamp time, double distance_s) {
    return queue.size() > 1 && std::abs(SecondsBetween(queue[1].time, time)) < distance_s;
  }

  Match TakeFronts() {
    Match match{firsts_.front().time, std::move(firsts_.front().item), seconds_.front().time,
                std::move(seconds_.front().item)};
    firsts_.pop_front();
    seconds_.pop_front();
    return match;
  }

  double max_skew_s_;
  std::size_t capacity_;
  Queue<First> firsts_;
  Queue<Second> seconds_;
  std::int64_t unmatched_first_ = 0;
  std::int64_t unmatched_second_ = 0;
};

}  // namespace deixis
