#include "common/transport/sample_window.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace deixis::transport {

void SampleWindow::Add(double value_ms) { values_ms_[count_++ % values_ms_.size()] = value_ms; }

Percentiles SampleWindow::Summarise() const {
  const std::size_t n = std::min(count_, values_ms_.size());
  if (n == 0) return {};
  std::vector<double> sorted(values_ms_.begin(),
                             values_ms_.begin() + static_cast<std::ptrdiff_t>(n));
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double share) {
    return sorted[static_cast<std::size_t>(std::lround(share * static_cast<double>(n - 1)))];
  };
  return {at(0.5), at(0.99)};
}

}  // namespace deixis::transport
