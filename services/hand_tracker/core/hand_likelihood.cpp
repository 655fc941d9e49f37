#include "services/hand_tracker/core/hand_likelihood.h"

#include <algorithm>
#include <cmath>

namespace deixis::hand_tracker {
namespace {

/// Collects names and values of what is visited.
struct Collector {
  std::array<const char*, HandLooks{}.size()> names{};
  HandLooks values{};
  std::size_t count = 0;
  void operator()(const char* name, double value) {
    names.at(count) = name;
    values.at(count++) = value;
  }
};

double WeighedSum(const HandLikelihoodWeights& weights, const HandLooks& looks) {
  HandLikelihoodWeights copy = weights;  // Visit is for writing, too.
  Collector collector;
  copy.Visit(collector);
  double sum = 0.0;
  for (std::size_t i = 0; i < looks.size(); ++i) sum += collector.values[i] * looks[i];
  return sum;
}

}  // namespace

void HandLikelihoodConfig::Validate() const {
  config::Faults faults;
  faults.Require(least < 0.0, "least", "must be negative");
  faults.Require(largest > 0.0, "largest", "must be positive");
  faults.ThrowIfAny();
}

HandLooks LooksOf(const HandCandidate& candidate) {
  constexpr double kLeastArea = 0.02;
  constexpr double kLongRegion = 2.0;
  constexpr double kLongestRegion = 6.0;  // Longer ones tell no more.
  constexpr double kFarRoot = 3.2;
  constexpr double kFarCentre = 3.6;
  constexpr double kNearCentre = 1.2;
  const double unit = candidate.hand_length_px;
  const double log_area = std::log(std::max(candidate.area_px / (unit * unit), kLeastArea));
  const double length = std::min(candidate.region_length_px / unit, kLongestRegion);
  const double centre = candidate.shoulder_distance_px / unit;
  const bool knows_shoulder = candidate.shoulder >= 0;
  return {1.0,
          log_area,
          log_area * log_area,
          std::max(0.0, length - kLongRegion),
          std::max(0.0, candidate.root_distance_px / unit - kFarRoot),
          std::max(0.0, centre - kFarCentre),
          knows_shoulder ? std::max(0.0, kNearCentre - centre) : 0.0,
          candidate.is_at_shoulder ? 1.0 : 0.0,
          candidate.is_at_face ? 1.0 : 0.0,
          candidate.moving_share,
          candidate.moving_share * candidate.moving_share,
          candidate.fresh_share,
          candidate.moving_share * candidate.fresh_share,
          candidate.is_by_motion_alone ? 1.0 : 0.0};
}

std::array<const char*, 14> NamesOfLooks() {
  HandLikelihoodWeights weights;
  Collector collector;
  weights.Visit(collector);
  return collector.names;
}

HandEvidence Judge(const HandLikelihoodConfig& config, const HandCandidate& candidate) {
  const HandLooks looks = LooksOf(candidate);
  return {std::clamp(WeighedSum(config.resting, looks), config.least, config.largest),
          std::clamp(WeighedSum(config.moving, looks), config.least, config.largest)};
}

}  // namespace deixis::hand_tracker
