#include "common/capture/pacer.h"

namespace deixis::capture {
namespace {

constexpr std::int64_t kSecond_us = 1'000'000;
constexpr std::int64_t kMostLate_us = kSecond_us;

}  // namespace

Pacer::Pacer(Pace pace, std::int64_t start_time_utime)
    : pace_(pace), start_time_utime_(start_time_utime) {}

bool Pacer::IsDue(Timestamp recorded, Timestamp now) {
  if (!began_) {
    began_ = now;
    if (start_time_utime_ < 0) start_time_utime_ = pace_ == Pace::kByTime ? now.microseconds : 0;
  }
  if (pace_ == Pace::kAsFastAsPossible) return true;
  late_us_ = now.microseconds - began_->microseconds - recorded.microseconds;
  return late_us_ >= 0;
}

std::string Pacer::trouble() const {
  if (late_us_ <= kMostLate_us) return "";
  return "plays " + std::to_string(late_us_ / kSecond_us) +
         " s late: this machine is too slow for the recording's rate";
}

Timestamp Pacer::CaptureTime(Timestamp recorded) const {
  return {start_time_utime_ + recorded.microseconds};
}

}  // namespace deixis::capture
