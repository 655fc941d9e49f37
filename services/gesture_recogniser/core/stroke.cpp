#include "services/gesture_recogniser/core/stroke.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/filtering/log_probability.h"
#include "services/gesture_recogniser/core/index.h"

namespace deixis::gesture_recogniser {

using filtering::kImpossible;
using filtering::LogAdd;
using filtering::LogNormal;

namespace {

constexpr double kNoiseTolerance =
    0.05;  // Tables are made anew when the noise changes by this share.
constexpr double kMeanOfRayleigh = 1.25;  // Mean length of plane noise of sigma 1.

// Of jumps that no hand can make: sums of the logarithm stay finite, differences of them defined.
constexpr double kLeastDensity = std::numeric_limits<double>::min();

void Normalise(std::vector<double>& log_priors) {
  double sum = kImpossible;
  for (const double prior : log_priors) sum = LogAdd(sum, prior);
  for (double& prior : log_priors) prior -= sum;
}

/// Value of a model's field at `phase` in [0, 1].
double FieldAt(const GestureModel& model, double phase, double ModelPoint::*field) {
  const double place = phase * static_cast<double>(model.points.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(place), model.points.size() - 2);
  const double share = place - static_cast<double>(low);
  return (1.0 - share) * model.points[low].*field + share * model.points[low + 1].*field;
}

double LogRayleigh(double speed, double sigma) {
  const double floor = std::max(speed, 0.3 * sigma);
  return std::log(floor / (sigma * sigma)) - 0.5 * speed * speed / (sigma * sigma);
}

}  // namespace

void StrokeConfig::Validate() const {
  config::Faults faults;
  faults.Require(spread_factor > 0.0 && spread_factor <= 10.0, "spread_factor",
                 "must lie in (0, 10]");
  faults.Require(amplitudes >= 2 && amplitudes <= 64, "amplitudes", "must lie between 2 and 64");
  faults.Require(noise_ratio >= 0.0, "noise_ratio", "must not be negative");
  faults.Require(free_slow_m_per_s > 0.0, "free_slow_m_per_s", "must be positive");
  faults.Require(free_fast_m_per_s > 0.0, "free_fast_m_per_s", "must be positive");
  faults.Require(resting_m_per_s > 0.0, "resting_m_per_s", "must be positive");
  faults.ThrowIfAny();
}

Stroke::Stroke(const StrokeConfig& config, const GestureModel& model, double step_s)
    : config_(config) {
  const double spread = config.spread_factor * model.stroke.peak_speed_log_spread;
  for (int i = 0; i < config.amplitudes; ++i) {
    const double deviations = -2.5 + 5.0 * i / (config.amplitudes - 1);
    amplitude_m_per_s_.push_back(model.stroke.peak_speed_m_per_s * std::exp(deviations * spread));
    amplitude_log_prior_.push_back(-0.5 * deviations * deviations);
  }
  Normalise(amplitude_log_prior_);
  sums_.resize(amplitude_m_per_s_.size());
  FillShapes(model, step_s);
}

void Stroke::FillShapes(const GestureModel& model, double step_s) {
  const double spread_s = config_.spread_factor * model.stroke.duration_spread_s;
  const int shortest = std::max(3, static_cast<int>((model.duration_s - 2.0 * spread_s) / step_s));
  const int longest =
      std::max(shortest, static_cast<int>((model.duration_s + 2.0 * spread_s) / step_s + 0.5));
  std::vector<double> log_priors;
  for (int steps = shortest; steps <= longest; ++steps) {
    Duration duration;
    duration.steps = steps;
    for (int lag = 0; lag <= steps; ++lag) {
      const double phase = 1.0 - static_cast<double>(lag) / steps;
      duration.shape.push_back(FieldAt(model, phase, &ModelPoint::shape));
      duration.shape_spread.push_back(FieldAt(model, phase, &ModelPoint::shape_spread));
    }
    log_priors.push_back(LogNormal(steps * step_s - model.duration_s, spread_s));
    durations_.push_back(std::move(duration));
  }
  Normalise(log_priors);
  for (std::size_t i = 0; i < durations_.size(); ++i) durations_[i].log_prior = log_priors[i];
}

void Stroke::FitNoise(double noise_m_per_s) {
  if (std::abs(noise_m_per_s - noise_m_per_s_) <= kNoiseTolerance * noise_m_per_s_) return;
  noise_m_per_s_ = noise_m_per_s;
  for (Duration& duration : durations_) FitNoise(duration);
}

void Stroke::FitNoise(Duration& duration) const {
  const std::size_t amplitudes = amplitude_m_per_s_.size();
  const std::size_t size = duration.shape.size() * amplitudes;
  duration.mean.resize(size);
  duration.inverse_sd.resize(size);
  duration.log_norm.resize(size);
  for (std::size_t lag = 0; lag < duration.shape.size(); ++lag) {
    for (std::size_t a = 0; a < amplitudes; ++a) {
      const double sd =
          std::hypot(amplitude_m_per_s_[a] * duration.shape_spread[lag], noise_m_per_s_);
      const std::size_t at = lag * amplitudes + a;
      duration.mean[at] = static_cast<float>(std::hypot(amplitude_m_per_s_[a] * duration.shape[lag],
                                                        kMeanOfRayleigh * noise_m_per_s_));
      duration.inverse_sd[at] = static_cast<float>(1.0 / sd);
      duration.log_norm[at] = static_cast<float>(LogNormal(0.0, sd));
    }
  }
}

void Stroke::Observe(const Motion& motion, int latest) {
  FitNoise(config_.noise_ratio * motion.sigma_m / (std::sqrt(2.0) * motion.step_s));
  Accumulate(motion);
  evidence_.clear();
  for (int steps_ago = 0; steps_ago <= latest; ++steps_ago) {
    evidence_.push_back(Evaluate(motion, steps_ago));
  }
}

void Stroke::Accumulate(const Motion& motion) {
  free_sum_.assign(1, 0.0);
  rest_sum_.assign(1, 0.0);
  const double resting = std::hypot(config_.resting_m_per_s, noise_m_per_s_);
  for (const double speed : motion.centred_speed_m_per_s) {
    const double slow = std::exp(-speed / config_.free_slow_m_per_s) / config_.free_slow_m_per_s;
    const double fast = std::exp(-speed / config_.free_fast_m_per_s) / config_.free_fast_m_per_s;
    const double density = std::max(0.5 * slow + 0.5 * fast, kLeastDensity);
    free_sum_.push_back(free_sum_.back() + std::log(density));
    rest_sum_.push_back(rest_sum_.back() + LogRayleigh(speed, resting));
  }
}

StrokeEvidence Stroke::Evaluate(const Motion& motion, int steps_ago) {
  StrokeEvidence evidence{kImpossible, 0.0};
  double best = kImpossible;
  for (const Duration& duration : durations_) {
    // The oldest sample has no speed yet.
    if (Index(steps_ago + duration.steps) + 1 >= motion.size()) break;
    const double log_odds = LogOdds(motion, steps_ago, duration) + duration.log_prior;
    evidence.log_odds = LogAdd(evidence.log_odds, log_odds);
    if (log_odds > best) {
      best = log_odds;
      evidence.duration_s = duration.steps * motion.step_s;
    }
  }
  return evidence;
}

double Stroke::LogOdds(const Motion& motion, int steps_ago, const Duration& duration) {
  const std::size_t amplitudes = sums_.size();
  for (std::size_t a = 0; a < amplitudes; ++a) sums_[a] = 0.0F;
  for (int lag = 0; lag <= duration.steps; ++lag) {
    const auto speed = static_cast<float>(motion.centred_speed_m_per_s[Index(steps_ago + lag)]);
    const std::size_t row = Index(lag) * amplitudes;
    for (std::size_t a = 0; a < amplitudes; ++a) {
      const float ratio = (speed - duration.mean[row + a]) * duration.inverse_sd[row + a];
      sums_[a] += duration.log_norm[row + a] - 0.5F * ratio * ratio;
    }
  }
  double sum = kImpossible;
  for (std::size_t a = 0; a < amplitudes; ++a) {
    sum = LogAdd(sum, static_cast<double>(sums_[a]) + amplitude_log_prior_[a]);
  }
  return sum - LogNull(steps_ago, duration.steps);
}

double Stroke::LogNull(int steps_ago, int steps) const {
  const std::size_t from = Index(steps_ago);
  const std::size_t to = Index(steps_ago + steps) + 1;
  return LogAdd(free_sum_[to] - free_sum_[from], rest_sum_[to] - rest_sum_[from]);
}

}  // namespace deixis::gesture_recogniser
