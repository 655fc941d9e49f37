#include "services/gesture_recogniser/core/decision.h"

#include <algorithm>

namespace deixis::gesture_recogniser {

int Largest(const std::vector<double>& values) {
  const auto largest = std::max_element(values.begin(), values.end());
  if (largest == values.end() || !(*largest > 0.0)) return -1;
  return static_cast<int>(largest - values.begin());
}

std::optional<Decision> DecideByWeight(double end_probability,
                                       const std::vector<double>& target_weight,
                                       double object_share, ContextNeed need) {
  Decision decision;
  const int best = Largest(target_weight);
  if (best >= 0 && need != ContextNeed::kNone &&
      target_weight[static_cast<std::size_t>(best)] > object_share * end_probability) {
    decision.outcome = scene::GestureOutcome::kObject;
    decision.target = best;
    return decision;
  }
  if (need == ContextNeed::kRequired) return std::nullopt;
  return decision;
}

}  // namespace deixis::gesture_recogniser
