#include "common/filtering/resampling.h"

#include <cmath>
#include <cstddef>

namespace deixis::filtering {
namespace {

double Sum(const std::vector<float>& weights) {
  double sum = 0.0;
  for (const float weight : weights) sum += static_cast<double>(weight);
  return sum;
}

}  // namespace

bool ResampleSystematically(const std::vector<float>& weights, float offset,
                            std::vector<int>& ancestors) {
  const double total = Sum(weights);
  if (!(total > 0.0) || !std::isfinite(total) || ancestors.empty()) return false;
  const double slice = total / static_cast<double>(ancestors.size());
  std::size_t source = 0;
  double reached = static_cast<double>(weights[0]);
  for (std::size_t i = 0; i < ancestors.size(); ++i) {
    const double wanted = (static_cast<double>(i) + static_cast<double>(offset)) * slice;
    while (wanted >= reached && source + 1 < weights.size()) {
      reached += static_cast<double>(weights[++source]);
    }
    ancestors[i] = static_cast<int>(source);
  }
  return true;
}

}  // namespace deixis::filtering
