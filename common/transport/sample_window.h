#pragma once
#include <array>
#include <cstddef>

#include "common/transport/bus.h"

namespace deixis::transport {

/// The last 512 durations, for percentiles.
class SampleWindow {
 public:
  void Add(double value_ms);
  Percentiles Summarise() const;

 private:
  std::array<double, 512> values_ms_{};
  std::size_t count_ = 0;
};

}  // namespace deixis::transport
