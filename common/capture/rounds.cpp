#include "common/capture/rounds.h"

#include <cmath>

namespace deixis::capture {

Timestamp Rounds::Shifted(Timestamp time, double period_s) {
  has_given_ = true;
  time.microseconds += start_.microseconds;
  next_start_.microseconds = time.microseconds + std::llround(1e6 * period_s);
  return time;
}

void Rounds::BeginNext() {
  start_ = next_start_;
  has_given_ = false;
}

}  // namespace deixis::capture
