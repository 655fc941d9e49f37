#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <utility>

#include "common/time/timestamp.h"

namespace deixis {

/// Items of one stream that wait to be matched; their times grow. An item that contradicts one
/// earlier time takes that one's place, since that one's time was wrong; one that contradicts two
/// is wrong itself, unless the next agrees with it: then time has begun anew.
template <typename T>
class WaitingItems {
 public:
  struct Timed {
    Timestamp time;
    T item;
  };

  /// Waits with `capacity` items at most, 1 or more: then the oldest go.
  explicit WaitingItems(std::size_t capacity) : capacity_(std::max<std::size_t>(capacity, 1)) {}

  void Add(Timestamp time, T item) {
    if (doubtful_) Decide(time);
    if (!(before_last_ < time)) {
      doubtful_ = Timed{time, std::move(item)};
    } else {
      Push({time, std::move(item)});
    }
  }

  void DropFront() {
    items_.pop_front();
    ++dropped_;
  }
  void DropAll() {
    while (!items_.empty()) DropFront();
    if (doubtful_) ++dropped_;
    doubtful_.reset();
  }
  Timed TakeFront() {
    Timed front = std::move(items_.front());
    items_.pop_front();
    return front;
  }

  /// Whether two or more wait, and none contradicts them.
  bool AreTwoSure() const { return items_.size() > 1 && !doubtful_; }
  const std::deque<Timed>& items() const { return items_; }
  std::int64_t dropped() const { return dropped_; }

 private:
  static constexpr Timestamp kNever{std::numeric_limits<std::int64_t>::min()};

  void Push(Timed timed) {
    for (; !items_.empty() && !(items_.back().time < timed.time); ++dropped_) items_.pop_back();
    while (items_.size() >= capacity_) DropFront();
    if (last_ < timed.time) before_last_ = last_;
    last_ = timed.time;
    items_.push_back(std::move(timed));
  }

  /// What becomes of the doubtful item, now that the next one's time is known.
  void Decide(Timestamp next) {
    if (doubtful_->time < next && !(last_ < next)) {
      before_last_ = last_ = kNever;
      Push(std::move(*doubtful_));
    } else {
      ++dropped_;
    }
    doubtful_.reset();
  }

  std::size_t capacity_;
  std::deque<Timed> items_;
  std::optional<Timed> doubtful_;
  Timestamp before_last_ = kNever;  ///< Of the item that came before the last one; it may be gone.
  Timestamp last_ = kNever;
  std::int64_t dropped_ = 0;
};

/// Items of two streams that were taken together.
template <typename First, typename Second>
struct TimeMatch {
  Timestamp first_time;
  First first;
  Timestamp second_time;
  Second second;
};

/// Finds which items of two streams were taken together. Items may arrive in any order between the
/// streams; within a stream times grow, but one damaged time costs no item but its own. An item
/// goes out with the nearest one of the other stream that is there and no further than the skew; so
/// take a skew below half the period. It is dropped and counted when its partner has a nearer one,
/// or when two of the other stream lie beyond it: the time of one alone may be damaged.
template <typename First, typename Second>
class TimeMatcher {
 public:
  using Match = TimeMatch<First, Second>;

  /// Waits with at most `capacity` items per stream: the oldest go when the other stream is silent.
  explicit TimeMatcher(double max_skew_s, std::size_t capacity = 30)
      : max_skew_s_(max_skew_s), firsts_(capacity), seconds_(capacity) {}

  void AddFirst(Timestamp time, First item) { firsts_.Add(time, std::move(item)); }
  void AddSecond(Timestamp time, Second item) { seconds_.Add(time, std::move(item)); }

  /// The next match, in the order of time; call until there is none.
  std::optional<Match> Next() {
    while (first_waits() && second_waits()) {
      const Timestamp first = firsts_.items().front().time;
      const Timestamp second = seconds_.items().front().time;
      const double skew_s = SecondsBetween(first, second);
      if (HasNearer(seconds_, first, std::abs(skew_s))) {
        seconds_.DropFront();
      } else if (HasNearer(firsts_, second, std::abs(skew_s))) {
        firsts_.DropFront();
      } else if (std::abs(skew_s) <= max_skew_s_) {
        return TakeFronts();
      } else if (skew_s < 0.0 && firsts_.AreTwoSure()) {
        seconds_.DropFront();
      } else if (skew_s > 0.0 && seconds_.AreTwoSure()) {
        firsts_.DropFront();
      } else {
        break;
      }
    }
    return std::nullopt;
  }

  /// Drops and counts what waits: the streams have ended.
  void Finish() {
    firsts_.DropAll();
    seconds_.DropAll();
  }

  /// Whether, when Next() found none, one more of that stream may bring a match.
  bool wants_first() const { return !first_waits() || second_waits(); }
  bool wants_second() const { return !second_waits() || first_waits(); }
  /// Whether, when Next() found none, nothing can match any more because streams have ended.
  bool IsOver(bool first_ended, bool second_ended) const {
    return (first_ended && second_ended) || (first_ended && !first_waits()) ||
           (second_ended && !second_waits());
  }
  std::int64_t unmatched_first() const { return firsts_.dropped(); }
  std::int64_t unmatched_second() const { return seconds_.dropped(); }

 private:
  bool first_waits() const { return !firsts_.items().empty(); }
  bool second_waits() const { return !seconds_.items().empty(); }

  /// Whether an item behind the front of `waiting` matches `time`, and better than the front does.
  template <typename T>
  bool HasNearer(const WaitingItems<T>& waiting, Timestamp time, double distance_s) const {
    const auto& items = waiting.items();
    return std::any_of(items.begin() + 1, items.end(), [&](const auto& item) {
      const double behind_s = std::abs(SecondsBetween(item.time, time));
      return behind_s < distance_s && behind_s <= max_skew_s_;
    });
  }

  Match TakeFronts() {
    auto first = firsts_.TakeFront();
    auto second = seconds_.TakeFront();
    return {first.time, std::move(first.item), second.time, std::move(second.item)};
  }

  double max_skew_s_;
  WaitingItems<First> firsts_;
  WaitingItems<Second> seconds_;
};

}  // namespace deixis
