// The hot loops of the sample set; compiled with the kernel flags.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "common/kernels/kernel.h"
#include "services/gesture_recogniser/core/sample_set.h"

namespace deixis::gesture_recogniser {
namespace {

/// Mean log-density of the window for a sample that is `phase` points into its model and moves
/// `stride` points per step. Steps before the model's beginning are not compared.
[[gnu::always_inline]] inline float MeanLogDensity(const ModelTable::Point* points, float phase,
                                                   float stride, float amplitude,
                                                   const Observations& observed) {
  const int reach = static_cast<int>(phase / stride) + 1;
  const int count = std::max(1, std::min(observed.count, reach));
  float sum = 0.0F;
  for (int j = 0; j < count; ++j) {
    const auto& point = points[static_cast<int>(phase - static_cast<float>(j) * stride)];
    const float speed =
        observed.speed_m_per_s[j] * point.inverse_speed_spread - amplitude * point.scaled_speed;
    const float turn = observed.turn_rad[j] * point.inverse_turn_spread - point.scaled_turn;
    sum += point.log_norm - 0.5F * (speed * speed + turn * turn);
  }
  return sum / static_cast<float>(count);
}

/// e^x by splitting into a power of two and a polynomial; relative error below 1e-4 for |x| < 80.
[[gnu::always_inline]] inline float FastExp(float x) {
  const float scaled = std::min(std::max(x, -80.0F), 80.0F) * 1.44269504F;
  const float whole = std::floor(scaled);
  const float part = (scaled - whole) * 0.693147181F;
  const float polynomial =
      1.0F + part * (1.0F + part * (0.5F + part * (0.16666667F +
                                                   part * (0.041666667F + part * 0.0083333333F))));
  const auto bits = static_cast<std::int32_t>(whole + 127.0F) << 23;
  float power = 0.0F;
  std::memcpy(&power, &bits, sizeof power);
  return polynomial * power;
}

}  // namespace

DEIXIS_KERNEL void WeighByMotion(const ModelTable& table, const Observations& observed,
                                 SampleSet& samples) {
  const std::size_t count = samples.size();
  for (std::size_t n = 0; n < count; ++n) {
    const float points_per_s = table.PointsPerSecond(samples.model[n]);
    samples.weight[n] = MeanLogDensity(
        table.Points(samples.model[n]), samples.phase_s[n] * points_per_s,
        samples.rate[n] * observed.step_s * points_per_s, samples.amplitude[n], observed);
  }
  float* weight = samples.weight.data();
  for (std::size_t n = 0; n < count; ++n) weight[n] = FastExp(weight[n]);
}

}  // namespace deixis::gesture_recogniser
