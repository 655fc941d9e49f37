#include "common/capture/pacer.h"

namespace deixis::capture {

Pacer::Pacer(Pace pace, std::int64_t start_time_utime)
    : pace_(pace), start_time_utime_(start_time_utime) {}

bool Pacer::IsDue(Timestamp recorded, Timestamp now) {
  if (!began_) {
    began_ = now;
    if (start_time_utime_ < 0) start_time_utime_ = pace_ == Pace::kByTime ? now.microseconds : 0;
  }
  if (pace_ == Pace::kAsFastAsPossible) return true;
  return now.microseconds - began_->microseconds >= recorded.microseconds;
}

Timestamp Pacer::CaptureTime(Timestamp recorded) const {
  return {start_time_utime_ + recorded.microseconds};
}

}  // namespace deixis::capture
