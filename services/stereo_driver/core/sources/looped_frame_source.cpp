#include "services/stereo_driver/core/sources/looped_frame_source.h"

#include <utility>

namespace deixis::stereo_driver {

using capture::SourceState;

LoopedFrameSource::LoopedFrameSource(std::function<std::unique_ptr<FrameSource>()> open)
    : open_(std::move(open)), source_(open_()) {}

FrameGrab LoopedFrameSource::Next() {
  FrameGrab grab = source_->Next();
  if (grab.state == SourceState::kFinished && rounds_.HasNext()) {
    BeginNextRound();
    grab = source_->Next();
  }
  if (grab.frame) grab.frame->time = rounds_.Shifted(grab.frame->time, grab.frame->period_s);
  return grab;
}

FrameSourceStatus LoopedFrameSource::status() const {
  FrameSourceStatus status = source_->status();
  status.pictures = capture::WithEarlier(before_.pictures, std::move(status.pictures));
  status.unmatched_left += before_.unmatched_left;
  status.unmatched_right += before_.unmatched_right;
  status.unusable += before_.unusable;
  return status;
}

void LoopedFrameSource::BeginNextRound() {
  before_ = status();
  source_ = open_();
  rounds_.BeginNext();
}

}  // namespace deixis::stereo_driver
