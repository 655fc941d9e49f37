#include "common/capture/looped_source.h"

#include <cmath>
#include <utility>

namespace deixis::capture {

LoopedSource::LoopedSource(std::function<std::unique_ptr<Source>()> open)
    : open_(std::move(open)), source_(open_()) {}

Grab LoopedSource::Next() {
  Grab grab = source_->Next();
  const bool has_time_left = next_round_start_ < kLatestTime;
  if (grab.state == SourceState::kFinished && pictures_in_round_ > 0 && has_time_left) {
    BeginNextRound();
    grab = source_->Next();
  }
  return ShiftToThisRound(std::move(grab));
}

SourceStatus LoopedSource::status() const {
  SourceStatus status = source_->status();
  status.corrupt += corrupt_before_;
  return status;
}

Grab LoopedSource::ShiftToThisRound(Grab grab) {
  if (!grab.picture) return grab;
  ++pictures_in_round_;
  Timestamp& time = grab.picture->time;
  time.microseconds += round_start_.microseconds;
  next_round_start_.microseconds = time.microseconds + std::llround(1e6 * grab.picture->period_s);
  return grab;
}

void LoopedSource::BeginNextRound() {
  corrupt_before_ += source_->status().corrupt;
  source_ = open_();
  round_start_ = next_round_start_;
  pictures_in_round_ = 0;
}

}  // namespace deixis::capture
