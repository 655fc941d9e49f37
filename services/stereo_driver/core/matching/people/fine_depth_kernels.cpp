#include "services/stereo_driver/core/matching/people/fine_depth_kernels.h"

#include "common/kernels/kernel.h"
#include "services/stereo_driver/core/matching/refinement_kernels.h"

namespace deixis::stereo_driver {
namespace {

[[gnu::always_inline]] inline std::uint16_t Millimetres(float disparity_px, FineDepthRange range) {
  const bool is_present = disparity_px > 0.0F;
  const float z_mm = range.focal_baseline_mm_px / (is_present ? disparity_px : 1.0F);
  const bool is_inside = is_present && z_mm >= range.nearest_mm && z_mm <= range.farthest_mm;
  return static_cast<std::uint16_t>(is_inside ? static_cast<int>(z_mm + 0.5F) : 0);
}

}  // namespace

DEIXIS_KERNEL void DoubleRow(const std::int16_t* half, int half_width, float* full_px) {
  constexpr float kFullPerSixteenth = 2.0F / 16.0F;
  for (int x = 0; x < half_width; ++x) {
    const float px = half[x] > 0 ? static_cast<float>(half[x]) * kFullPerSixteenth : kAbsent_px;
    full_px[2 * x] = full_px[2 * x + 1] = px;
  }
}

DEIXIS_KERNEL void DepthRow(const float* disparity_px, int width, FineDepthRange range,
                            std::uint16_t* depth_mm) {
  for (int x = 0; x < width; ++x) depth_mm[x] = Millimetres(disparity_px[x], range);
}

DEIXIS_KERNEL void HalvedDepthRow(const float* upper_px, const float* lower_px, int half_width,
                                  FineDepthRange range, std::uint16_t* depth_mm) {
  for (int x = 0; x < half_width; ++x) {
    const float sum = upper_px[2 * x] + upper_px[2 * x + 1] + lower_px[2 * x] + lower_px[2 * x + 1];
    depth_mm[x] = Millimetres(0.25F * sum, range);
  }
}

}  // namespace deixis::stereo_driver
