#include "test/benchmark/gesture_recogniser/naive_condensation.h"

#include <algorithm>
#include <cmath>

namespace deixis::gesture_recogniser {

NaiveCondensation::NaiveCondensation(const std::vector<GestureModel>& models, int samples)
    : models_(models), samples_(static_cast<std::size_t>(samples)) {
  for (Sample& sample : samples_) {
    Initialise(sample);
    sample.phase_s = uniform_(random_) * models_[static_cast<std::size_t>(sample.model)].duration_s;
  }
}

void NaiveCondensation::Initialise(Sample& sample) {
  sample.model = static_cast<int>(uniform_(random_) * static_cast<double>(models_.size()));
  const double root = std::sqrt(std::max(uniform_(random_), 1e-4));
  const double duration_s = models_[static_cast<std::size_t>(sample.model)].duration_s;
  sample.phase_s = std::min((1.0 - root) / root / 15.0, duration_s);
  sample.amplitude = 0.65 + 0.7 * uniform_(random_);
  sample.rate = 0.65 + 0.7 * uniform_(random_);
}

void NaiveCondensation::Select() {
  std::vector<double> sums;
  double sum = 0.0;
  for (const Sample& sample : samples_) sums.push_back(sum += sample.weight);
  std::vector<Sample> selected;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const auto found = std::lower_bound(sums.begin(), sums.end(), sum * uniform_(random_));
    selected.push_back(samples_[static_cast<std::size_t>(found - sums.begin())]);
  }
  samples_ = selected;
}

void NaiveCondensation::Predict(double step_s) {
  for (Sample& sample : samples_) {
    sample.amplitude = std::clamp(sample.amplitude + normal_(random_), 0.65, 1.35);
    sample.rate = std::clamp(sample.rate + normal_(random_), 0.65, 1.35);
    sample.phase_s += sample.rate * step_s;
    if (sample.phase_s > models_[static_cast<std::size_t>(sample.model)].duration_s) {
      Initialise(sample);
    }
  }
}

double NaiveCondensation::Density(const Sample& sample, const std::vector<double>& speeds,
                                  const std::vector<double>& turns, double step_s) const {
  const GestureModel& model = models_[static_cast<std::size_t>(sample.model)];
  const double last = static_cast<double>(model.points.size() - 1);
  double log_density = 0.0;
  int count = 0;
  for (std::size_t j = 0; j < speeds.size(); ++j, ++count) {
    const double phase_s = sample.phase_s - static_cast<double>(j) * sample.rate * step_s;
    if (phase_s < 0.0) break;
    const auto& point = model.points[static_cast<std::size_t>(phase_s / model.duration_s * last)];
    const double speed =
        (speeds[j] - sample.amplitude * point.speed_m_per_s) / point.speed_spread_m_per_s;
    const double turn = (turns[j] - point.turn_rad) / point.turn_spread_rad;
    log_density -= 0.5 * (speed * speed + turn * turn) +
                   std::log(6.283185307 * point.speed_spread_m_per_s * point.turn_spread_rad);
  }
  return std::exp(log_density / std::max(1, count));
}

double NaiveCondensation::Step(const std::vector<double>& speeds, const std::vector<double>& turns,
                               double step_s) {
  Select();
  Predict(step_s);
  double sum = 0.0;
  double end = 0.0;
  for (Sample& sample : samples_) {
    sample.weight = Density(sample, speeds, turns, step_s);
    sum += sample.weight;
    const GestureModel& model = models_[static_cast<std::size_t>(sample.model)];
    const bool has_ended = sample.phase_s > 0.9 * model.duration_s;
    if (has_ended && model.context != ContextNeed::kNone) end += sample.weight;
  }
  return end / sum;
}

}  // namespace deixis::gesture_recogniser
