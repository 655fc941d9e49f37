#include "services/gesture_recogniser/core/training.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace deixis::gesture_recogniser {
namespace {

struct Spread {
  double mean = 0.0;
  double deviation = 0.0;  ///< Standard deviation.
  double root_mean_square = 0.0;
};

/// Statistics of `value(example)` over all examples.
template <typename Value>
Spread Over(const std::vector<Example>& examples, Value value) {
  double sum = 0.0;
  double squares = 0.0;
  for (const Example& example : examples) {
    sum += value(example);
    squares += value(example) * value(example);
  }
  const double count = static_cast<double>(examples.size());
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean)),
          std::sqrt(squares / count)};
}

double Peak(const Example& example) {
  const auto& speed = example.centred_speed_m_per_s;
  return std::max(1e-3, *std::max_element(speed.begin(), speed.end()));
}

ModelPoint AveragePoint(const TrainingConfig& config, const std::vector<Example>& examples,
                        std::size_t i) {
  const Spread speed = Over(examples, [i](const Example& e) { return e.speed_m_per_s[i]; });
  const Spread turn = Over(examples, [i](const Example& e) { return e.turn_rad[i]; });
  const Spread shape =
      Over(examples, [i](const Example& e) { return e.centred_speed_m_per_s[i] / Peak(e); });
  ModelPoint point;
  point.speed_m_per_s = speed.mean;
  point.speed_spread_m_per_s = std::max(speed.deviation, config.smallest_speed_spread_m_per_s);
  // Turns to either side are alike, so their mean says nothing.
  point.turn_spread_rad = std::max(turn.root_mean_square, config.smallest_turn_spread_rad);
  point.shape = shape.mean;
  point.shape_spread = std::max(shape.deviation, config.smallest_shape_spread);
  return point;
}

/// The search radius holds nearly all examples and never grows with the phase.
void AddContext(const TrainingConfig& config, const std::vector<Example>& examples,
                std::vector<ModelPoint>& points) {
  double largest = 1e9;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double phase = static_cast<double>(i) / static_cast<double>(points.size() - 1);
    if (phase < config.context_begin) continue;
    const Spread gap = Over(examples, [i](const Example& e) { return e.gap_m[i]; });
    largest = std::min(largest, gap.mean + 2.0 * gap.deviation);
    points[i].context_radius_m = largest;
    points[i].context_start_rad = -config.context_half_angle_rad;
    points[i].context_end_rad = config.context_half_angle_rad;
  }
}

GestureModel Average(const TrainingConfig& config, const std::string& name,
                     const std::vector<Example>& examples) {
  if (examples.empty()) throw std::invalid_argument("no examples for model '" + name + "'");
  GestureModel model;
  model.name = name;
  model.examples = static_cast<int>(examples.size());
  const Spread duration = Over(examples, [](const Example& e) { return e.duration_s; });
  const Spread peak = Over(examples, [](const Example& e) { return std::log(Peak(e)); });
  model.duration_s = duration.mean;
  model.stroke.duration_spread_s = std::max(duration.deviation, 0.03);
  model.stroke.peak_speed_m_per_s = std::exp(peak.mean);
  model.stroke.peak_speed_log_spread = std::max(peak.deviation, 0.1);
  for (int i = 0; i < config.points; ++i) {
    model.points.push_back(AveragePoint(config, examples, static_cast<std::size_t>(i)));
  }
  return model;
}

}  // namespace

GestureModel TrainStroke(const TrainingConfig& config, const std::string& name,
                         const std::vector<Example>& examples) {
  GestureModel model = Average(config, name, examples);
  model.context = ContextNeed::kRequired;
  const Spread gap = Over(examples, [](const Example& e) { return e.final_gap_m; });
  model.target.gap_m = gap.mean;
  model.target.gap_spread_m = std::max(gap.deviation, 0.01);
  model.target.direction_spread_rad =
      Over(examples, [](const Example& e) { return e.arrival_error_rad; }).root_mean_square;
  model.target.posture_spread_rad =
      Over(examples, [](const Example& e) { return e.posture_error_rad; }).root_mean_square;
  AddContext(config, examples, model.points);
  return model;
}

GestureModel TrainRest(const TrainingConfig& config, const std::string& name,
                       const std::vector<Example>& examples) {
  return Average(config, name, examples);
}

}  // namespace deixis::gesture_recogniser
