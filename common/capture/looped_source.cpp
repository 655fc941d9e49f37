#include "common/capture/looped_source.h"

#include <utility>

namespace deixis::capture {

LoopedSource::LoopedSource(std::function<std::unique_ptr<Source>()> open)
    : open_(std::move(open)), source_(open_()) {}

Grab LoopedSource::Next() {
  Grab grab = source_->Next();
  if (grab.state == SourceState::kFinished && rounds_.HasNext()) {
    BeginNextRound();
    grab = source_->Next();
  }
  if (grab.picture)
    grab.picture->time = rounds_.Shifted(grab.picture->time, grab.picture->period_s);
  return grab;
}

SourceStatus LoopedSource::status() const { return WithEarlier(before_, source_->status()); }

void LoopedSource::BeginNextRound() {
  before_ = status();
  source_ = open_();
  rounds_.BeginNext();
}

}  // namespace deixis::capture
