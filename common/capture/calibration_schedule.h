#pragma once
#include <cmath>
#include <optional>

#include "common/time/timestamp.h"

namespace deixis::capture {

/// When a driver says its calibration: before the first picture, then once per second of picture
/// time.
class CalibrationSchedule {
 public:
  /// Whether it goes out before the picture of `time`.
  bool IsDue(Timestamp time) const {
    // The absolute value, so that a clock that was set back does not silence the calibration.
    return !sent_ || std::abs(SecondsBetween(*sent_, time)) >= kPeriod_s;
  }
  void NoteSent(Timestamp time) { sent_ = time; }
  void BeginAnew() { sent_.reset(); }  ///< It has changed: due with the next picture.

 private:
  static constexpr double kPeriod_s = 1.0;
  std::optional<Timestamp> sent_;
};

}  // namespace deixis::capture
