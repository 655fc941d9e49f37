#pragma once
#include <chrono>

#include "common/capture/clocks.h"

namespace deixis::capture {

/// Time by one of the system's clocks.
template <typename Clock>
Timestamp TimeBy() {
  const auto since_start = Clock::now().time_since_epoch();
  return {std::chrono::duration_cast<std::chrono::microseconds>(since_start).count()};
}

/// The clocks of this machine: for services, which hand them on to what has none of its own.
inline Clocks SystemClocks() {
  // steady_clock is CLOCK_MONOTONIC on Linux.
  return {TimeBy<std::chrono::system_clock>, TimeBy<std::chrono::steady_clock>};
}

}  // namespace deixis::capture
