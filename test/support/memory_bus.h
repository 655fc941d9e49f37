#pragma once
#include <chrono>

#include "common/transport/bus.h"

namespace deixis::test {

/// For a bus that only its own process sees.
inline transport::BusOptions Memory() {
  transport::BusOptions options;
  options.url = "memq://";
  return options;
}

/// Handles everything that waits, and what comes of it.
inline void HandleAll(transport::Bus& bus) {
  while (bus.Handle(std::chrono::milliseconds{0}) > 0) {
  }
}

}  // namespace deixis::test
