#pragma once
#include <functional>

#include "common/time/timestamp.h"

namespace deixis::capture {

/// The clocks that a live camera needs, handed in from outside so that the core has none of its
/// own.
struct Clocks {
  std::function<Timestamp()> wall;  ///< Microseconds since 1970.
  std::function<Timestamp()>
      monotonic;  ///< Microseconds of CLOCK_MONOTONIC, which drivers stamp with.
};

}  // namespace deixis::capture
