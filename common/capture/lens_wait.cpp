#include "common/capture/lens_wait.h"

namespace deixis::capture {
namespace {

constexpr double kLongest_s = 2.0;

}  // namespace

bool LensWait::Holds(const Calibration& calibration, Timestamp time) {
  is_over_ = is_over_ || calibration.IsKnown() || IsOver(time);
  if (!is_over_) ++held_back_;
  return !is_over_;
}

// Times that stand still or go back would never say that two seconds are over.
bool LensWait::IsOver(Timestamp time) {
  const bool goes_on = !last_ || time.microseconds > last_->microseconds;
  if (!first_) first_ = time;
  last_ = time;
  return !goes_on || SecondsBetween(*first_, time) >= kLongest_s;
}

}  // namespace deixis::capture
