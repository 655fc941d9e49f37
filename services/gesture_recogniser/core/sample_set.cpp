#include "services/gesture_recogniser/core/sample_set.h"

#include <algorithm>
#include <cmath>

#include "common/filtering/log_probability.h"

namespace deixis::gesture_recogniser {

using filtering::kTwoPi;

namespace {

ModelTable::Point Prepare(const ModelPoint& point) {
  const double inverse_speed = 1.0 / point.speed_spread_m_per_s;
  const double inverse_turn = 1.0 / point.turn_spread_rad;
  return {static_cast<float>(inverse_speed),
          static_cast<float>(point.speed_m_per_s * inverse_speed),
          static_cast<float>(inverse_turn),
          static_cast<float>(point.turn_rad * inverse_turn),
          static_cast<float>(std::log(inverse_speed * inverse_turn / kTwoPi)),
          {}};
}

}  // namespace

void SampleSet::Resize(std::size_t count) {
  model.resize(count, 0);
  phase_s.resize(count, 0.0F);
  amplitude.resize(count, 1.0F);
  rate.resize(count, 1.0F);
  bound.resize(count, -1);
  weight.resize(count, 0.0F);
}

void SampleSet::Copy(const SampleSet& from, std::size_t source, std::size_t destination) {
  model[destination] = from.model[source];
  phase_s[destination] = from.phase_s[source];
  amplitude[destination] = from.amplitude[source];
  rate[destination] = from.rate[source];
  bound[destination] = from.bound[source];
}

ModelTable::ModelTable(const std::vector<GestureModel>& models) {
  for (const GestureModel& model : models) {
    first_.push_back(points_.size());
    last_.push_back(static_cast<int>(model.points.size()) - 1);
    duration_s_.push_back(static_cast<float>(model.duration_s));
    points_per_s_.push_back(static_cast<float>(last_.back() / model.duration_s));
    for (const ModelPoint& point : model.points) points_.push_back(Prepare(point));
  }
}

int ModelTable::PointAt(int model, float phase_s) const {
  const int point = static_cast<int>(phase_s * PointsPerSecond(model) + 0.5F);
  return std::clamp(point, 0, last_[Index(model)]);
}

}  // namespace deixis::gesture_recogniser
