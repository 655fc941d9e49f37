#include "services/gesture_recogniser/core/hold.h"

#include <algorithm>
#include <cmath>

#include "common/filtering/log_probability.h"

namespace deixis::gesture_recogniser {

using filtering::LogAdd;
using filtering::LogPlaneNormal;

namespace {

/// Straight line through samples at equal steps.
struct Line {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Vector2d slope_per_step = Eigen::Vector2d::Zero();
  double squared_steps = 0.0;     ///< Sum of squared distances from the middle, steps^2.
  double squared_residual = 0.0;  ///< Sum over samples and axes.
};

Line FitLine(const Motion& motion, int samples) {
  Line line;
  const double middle = 0.5 * (samples - 1);
  for (int i = 0; i < samples; ++i) {
    const Eigen::Vector2d& position = motion.position_m[static_cast<std::size_t>(i)];
    line.mean += position / samples;
    line.slope_per_step += (middle - i) * position;
    line.squared_steps += (middle - i) * (middle - i);
  }
  line.slope_per_step /= line.squared_steps;
  for (int i = 0; i < samples; ++i) {
    const Eigen::Vector2d expected = line.mean + (middle - i) * line.slope_per_step;
    line.squared_residual +=
        (motion.position_m[static_cast<std::size_t>(i)] - expected).squaredNorm();
  }
  return line;
}

}  // namespace

void HoldConfig::Validate() const {
  config::Faults faults;
  faults.Require(shortest_s > 0.0, "shortest_s", "must be positive");
  faults.Require(longest_s >= shortest_s, "longest_s", "must not be below shortest_s");
  faults.Require(drift_m_per_s > 0.0, "drift_m_per_s", "must be positive");
  faults.Require(free_slow_m_per_s > drift_m_per_s, "free_slow_m_per_s",
                 "must exceed drift_m_per_s");
  faults.Require(free_fast_m_per_s > drift_m_per_s, "free_fast_m_per_s",
                 "must exceed drift_m_per_s");
  faults.Require(tremor_factor >= 1.0, "tremor_factor", "must be at least 1");
  faults.ThrowIfAny();
}

HoldEvidence JudgeHold(const HoldConfig& config, const Motion& motion, int samples) {
  const Line line = FitLine(motion, samples);
  const double sigma = std::max(motion.sigma_m, 1e-4);
  const double drift = line.slope_per_step.norm() / motion.step_s;
  const double drift_sigma = sigma / std::sqrt(line.squared_steps) / motion.step_s;
  const auto density = [&](double spread) {
    return LogPlaneNormal(drift, std::hypot(spread, drift_sigma));
  };
  const double moving =
      LogAdd(density(config.free_slow_m_per_s), density(config.free_fast_m_per_s)) - std::log(2.0);
  const double tremor = config.tremor_factor * sigma;
  // What scatters more than a held hand does bends or stops within these samples.
  const double excess = line.squared_residual / (tremor * tremor) - 2.0 * (samples - 2);
  HoldEvidence evidence;
  evidence.log_odds = density(config.drift_m_per_s) - moving - std::max(0.0, 0.5 * excess);
  evidence.position_m = line.mean;
  evidence.sigma_m = sigma / std::sqrt(static_cast<double>(samples));
  return evidence;
}

}  // namespace deixis::gesture_recogniser
