#include "services/stereo_driver/core/depth_registration_kernels.h"

#include <algorithm>

namespace deixis::stereo_driver {
namespace {

constexpr float kNearest_mm = 1.0F;
constexpr float kFarthest_mm = 65535.0F;  // What 16 bits say.

}  // namespace

void ProjectRow(const Rays& rays, const Offset& offset, const std::uint16_t* depth_mm, int width,
                const Projected& projected) {
  for (int x = 0; x < width; ++x) {
    const float depth = depth_mm[x];
    const float z = rays.z[x] * depth + offset.z;
    projected.u_px[x] = (rays.u[x] * depth + offset.u) / z;
    projected.v_px[x] = (rays.v[x] * depth + offset.v) / z;
    const bool is_seen = (depth > 0.0F) & (z >= kNearest_mm) & (z <= kFarthest_mm);
    projected.z_mm[x] = is_seen ? z : 0.0F;
  }
}

void FindSurface(const float* upper_z_mm, const float* lower_z_mm, int width,
                 std::uint8_t* goes_on) {
  for (int x = 0; x + 1 < width; ++x) {
    const float a = upper_z_mm[x], b = upper_z_mm[x + 1];
    const float c = lower_z_mm[x], d = lower_z_mm[x + 1];
    const float nearest = std::min(std::min(a, b), std::min(c, d));
    const float farthest = std::max(std::max(a, b), std::max(c, d));
    const bool is_one = (nearest > 0.0F) & (farthest - nearest <= kSurfaceShare * nearest);
    goes_on[x] = is_one ? 1 : 0;
  }
}

}  // namespace deixis::stereo_driver
