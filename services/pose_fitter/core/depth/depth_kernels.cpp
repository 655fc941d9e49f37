#include "services/pose_fitter/core/depth/depth_kernels.h"

#include <cmath>
#include <initializer_list>

#include "common/kernels/kernel.h"

namespace deixis::pose_fitter {
namespace {

/// 1 where `other` was measured and is further from `here` than `limit`.
[[gnu::always_inline]] inline int IsStep(float here, float other, float limit) {
  return static_cast<int>(other > 0.0F) & static_cast<int>(std::abs(here - other) > limit);
}

[[gnu::always_inline]] inline float LimitAt(StepLimit limit, float z) {
  return limit.fixed_m + z * (limit.per_m + z * limit.per_square_m);
}

[[gnu::always_inline]] inline std::uint8_t IsSound(float left, float z, float right, float above,
                                                   float below, float limit) {
  const int beside = IsStep(z, left, limit) & IsStep(z, right, limit);
  const int upright = IsStep(z, above, limit) & IsStep(z, below, limit);
  return static_cast<std::uint8_t>(static_cast<int>(z > 0.0F) & ~(beside | upright) & 1);
}

}  // namespace

DEIXIS_KERNEL void MarkSoundRow(const float* above_m, const float* row_m, const float* below_m,
                                int width, StepLimit limit, std::uint8_t* is_sound) {
  for (int x = 1; x < width - 1; ++x) {
    const float z = row_m[x];
    is_sound[x] = IsSound(row_m[x - 1], z, row_m[x + 1], above_m[x], below_m[x], LimitAt(limit, z));
  }
  for (const int x : {0, width - 1}) {
    const float z = row_m[x];
    is_sound[x] = IsSound(0.0F, z, 0.0F, above_m[x], below_m[x], LimitAt(limit, z));
  }
}

}  // namespace deixis::pose_fitter
