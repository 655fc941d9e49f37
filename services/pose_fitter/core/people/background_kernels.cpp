#include "services/pose_fitter/core/people/background_kernels.h"

#include <algorithm>
#include <cmath>

#include "common/kernels/kernel.h"

namespace deixis::pose_fitter {
namespace {

constexpr float kStep = 0.05F;  // Of the tolerance: how far a running median goes per image.
constexpr float kLongest_s = 1e4F;

[[gnu::always_inline]] inline float LimitAt(StepLimit limit, float z) {
  return limit.fixed_m + z * (limit.per_m + z * limit.per_square_m);
}

}  // namespace

DEIXIS_KERNEL void LearnBackgroundRow(const float* __restrict row_m,
                                      const std::uint8_t* __restrict is_sound,
                                      const std::uint8_t* __restrict is_occupied, int width,
                                      const BackgroundRule& rule, float* __restrict background_m,
                                      float* __restrict seen_s, float* __restrict other_s) {
  for (int u = 0; u < width; ++u) {
    if (is_sound[u] == 0 || (is_occupied != nullptr && is_occupied[u] != 0)) continue;
    const float z = row_m[u];
    const float limit = LimitAt(rule.same, z);
    const float step = z - background_m[u];
    if (std::abs(step) < limit && seen_s[u] > 0.0F) {
      background_m[u] += std::clamp(step, -kStep * limit, kStep * limit);
      seen_s[u] = std::min(seen_s[u] + rule.elapsed_s, kLongest_s);
      other_s[u] = 0.0F;
      continue;
    }
    // Farther things were there before; nearer ones may be people.
    other_s[u] += rule.elapsed_s;
    const bool is_known = seen_s[u] >= rule.still_s;
    const float wait_s = !is_known ? 0.0F : step > 0.0F ? rule.still_s : rule.nearer_s;
    if (other_s[u] < wait_s) continue;
    background_m[u] = z;
    seen_s[u] = std::max(rule.elapsed_s, 1e-6F);
    other_s[u] = 0.0F;
  }
}

DEIXIS_KERNEL BackgroundMatch MarkForegroundRow(const float* __restrict row_m,
                                                const std::uint8_t* __restrict is_sound, int width,
                                                const BackgroundRule& rule,
                                                const float* __restrict background_m,
                                                const float* __restrict seen_s,
                                                std::uint8_t* __restrict is_foreground) {
  int known_count = 0;
  int different_count = 0;
  for (int u = 0; u < width; ++u) {
    const float z = row_m[u];
    const int is_known = is_sound[u] & static_cast<int>(seen_s[u] >= rule.still_s);
    const int is_other = static_cast<int>(std::abs(z - background_m[u]) >= LimitAt(rule.same, z));
    known_count += is_known;
    different_count += is_known & is_other;
    is_foreground[u] =
        static_cast<std::uint8_t>(is_sound[u] & ((is_known & is_other) | (1 - is_known)));
  }
  return {known_count, different_count};
}

}  // namespace deixis::pose_fitter
