#include "common/transport/publisher_sequences.h"

#include <algorithm>
#include <cstdlib>

namespace deixis::transport {
namespace {

// A larger jump is no loss but a publisher that counts anew, or a forged number.
constexpr std::int64_t kLargestGap = 100'000;
// Two counts closer than this may be one whose datagrams overtake each other.
constexpr std::int64_t kOvertaken = 8;
// So much of a count may be lost, or passed over by a slow reader, before it is returned to.
constexpr std::int64_t kLongestLeap = 1000;
constexpr std::size_t kMostCounts = 4;
constexpr std::chrono::seconds kCountMemory{5};
constexpr std::chrono::seconds kSignMemory{10};

}  // namespace

void PublisherSequences::Observe(std::int64_t sequence, Timestamp time, std::int64_t skipped,
                                 Clock::time_point now) {
  if (sequence < 0) return;
  Forget(now);
  if (IsRepeated(sequence)) {
    if (IsOfAnotherTime(sequence, time)) NoteSecondPublisher(now);
    Remember(sequence, time, now);
    return;
  }
  const auto before = CountBefore(sequence);
  if (!before) {
    seen_.fill({});
    Begin(sequence, 0);
  } else if (*before + 1 == counts_.size()) {
    Continue(sequence, skipped);
  } else {
    ReturnTo(*before, sequence, now);
  }
  Remember(sequence, time, now);
}

// All but the current one grow old.
void PublisherSequences::Forget(Clock::time_point now) {
  if (counts_.empty()) return;
  const auto is_old = [now](const Count& count) { return now - count.heard > kCountMemory; };
  counts_.erase(std::remove_if(counts_.begin(), counts_.end() - 1, is_old), counts_.end() - 1);
}

// Far behind the current number it is a publisher that counts anew.
bool PublisherSequences::IsRepeated(std::int64_t sequence) const {
  if (sequence == 0 || counts_.empty()) return false;
  const std::int64_t behind = counts_.back().last - sequence;
  return behind >= 0 && behind <= kOvertaken &&
         std::any_of(seen_.begin(), seen_.end(),
                     [sequence](const Seen& seen) { return seen.sequence == sequence; });
}

// The network may have doubled a datagram: that one has the same time.
bool PublisherSequences::IsOfAnotherTime(std::int64_t sequence, Timestamp time) const {
  return std::any_of(seen_.begin(), seen_.end(), [&](const Seen& seen) {
    return seen.sequence == sequence && seen.time != time;
  });
}

// Numbers go up, so of several counts the closest one goes on; of two alike, the current one.
std::optional<std::size_t> PublisherSequences::CountBefore(std::int64_t sequence) const {
  std::optional<std::size_t> closest;
  for (std::size_t i = counts_.size(); i-- > 0;) {
    const bool is_current = i + 1 == counts_.size();
    const std::int64_t leap = sequence - counts_[i].last;
    if (leap <= 0 || leap > (is_current ? kLargestGap + 1 : kLongestLeap)) continue;
    if (!closest || counts_[i].last > counts_[*closest].last) closest = i;
  }
  return closest;
}

void PublisherSequences::Continue(std::int64_t sequence, std::int64_t skipped) {
  const std::int64_t missing = sequence - counts_.back().last - 1 - skipped;
  if (missing <= 0) {
    counts_.back().last = sequence;
    return;
  }
  gaps_ += missing;
  Begin(sequence, missing);
}

// What came in between was no gap but the other count, or a datagram that was overtaken.
void PublisherSequences::ReturnTo(std::size_t count, std::int64_t sequence, Clock::time_point now) {
  const std::int64_t apart = std::abs(counts_.back().last - sequence);
  if (apart > kOvertaken) NoteSecondPublisher(now);
  gaps_ -= counts_.back().missing;
  counts_.back().missing = 0;
  counts_[count].last = sequence;
  std::rotate(counts_.begin() + static_cast<std::ptrdiff_t>(count),
              counts_.begin() + static_cast<std::ptrdiff_t>(count) + 1, counts_.end());
}

void PublisherSequences::Begin(std::int64_t sequence, std::int64_t missing) {
  if (counts_.size() == kMostCounts) counts_.erase(counts_.begin());
  counts_.push_back({sequence, missing, {}});
}

void PublisherSequences::NoteSecondPublisher(Clock::time_point now) {
  ++out_of_turn_;
  std::rotate(signs_.begin(), signs_.begin() + 1, signs_.end());
  signs_.back() = now;
}

void PublisherSequences::Remember(std::int64_t sequence, Timestamp time, Clock::time_point now) {
  if (!counts_.empty()) counts_.back().heard = now;
  seen_[next_seen_] = {sequence, time};
  next_seen_ = (next_seen_ + 1) % seen_.size();
}

bool PublisherSequences::HasTwoPublishers(Clock::time_point now) const {
  return signs_.front() != Clock::time_point{} && now - signs_.front() <= kSignMemory;
}

}  // namespace deixis::transport
