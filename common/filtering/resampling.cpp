#include "common/filtering/resampling.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace deixis::filtering {
namespace {

double Sum(const std::vector<float>& weights) {
  double sum = 0.0;
  for (const float weight : weights) sum += static_cast<double>(weight);
  return sum;
}

/// The sum is walked once; `offset_of(i)` in [0, 1) says where in its slice ancestor i is drawn.
template <typename OffsetOf>
bool Walk(const std::vector<float>& weights, std::vector<int>& ancestors, OffsetOf offset_of) {
  const double total = Sum(weights);
  if (!(total > 0.0) || !std::isfinite(total) || ancestors.empty()) return false;
  const double slice = total / static_cast<double>(ancestors.size());
  std::size_t source = 0;
  double reached = static_cast<double>(weights[0]);
  for (std::size_t i = 0; i < ancestors.size(); ++i) {
    const double wanted = (static_cast<double>(i) + offset_of(i)) * slice;
    while (wanted >= reached && source + 1 < weights.size()) {
      reached += static_cast<double>(weights[++source]);
    }
    ancestors[i] = static_cast<int>(source);
  }
  return true;
}

}  // namespace

bool ResampleSystematically(const std::vector<float>& weights, float offset,
                            std::vector<int>& ancestors) {
  return Walk(weights, ancestors, [offset](std::size_t) { return static_cast<double>(offset); });
}

bool ResampleStratified(const std::vector<float>& weights, const CounterRandom& random,
                        std::vector<int>& ancestors) {
  return Walk(weights, ancestors, [&random](std::size_t i) {
    return static_cast<double>(random.Uniform(static_cast<std::uint64_t>(i)));
  });
}

}  // namespace deixis::filtering
