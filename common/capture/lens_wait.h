#pragma once
#include <cstdint>
#include <optional>

#include "common/capture/calibration.h"
#include "common/time/timestamp.h"

namespace deixis::capture {

/// Holds pictures back until the camera has said its lens, which may come a little later than its
/// first picture: for two seconds of picture time at most, since not every camera says it.
class LensWait {
 public:
  /// Whether the picture of `time` is to be passed over.
  bool Holds(const Calibration& calibration, Timestamp time);

  std::int64_t held_back() const { return held_back_; }  ///< Pictures.

 private:
  bool IsOver(Timestamp time);

  bool is_over_ = false;
  std::optional<Timestamp> first_;
  std::optional<Timestamp> last_;
  std::int64_t held_back_ = 0;
};

}  // namespace deixis::capture
