#include "services/stereo_driver/core/depth_camera/depth_registration_kernels.h"

#include "common/kernels/kernel.h"

namespace deixis::stereo_driver {
namespace {

constexpr float kNearest_mm = 1.0F;
constexpr float kFarthest_mm = 65535.0F;  // What 16 bits say.

[[gnu::always_inline]] inline void ProjectCoordinate(const float* rays, float offset,
                                                     const float* rays_z, float offset_z,
                                                     const std::uint16_t* depth_mm, int width,
                                                     float* projected_px) {
  for (int x = 0; x < width; ++x) {
    const float depth = depth_mm[x];
    projected_px[x] = (rays[x] * depth + offset) / (rays_z[x] * depth + offset_z);
  }
}

}  // namespace

DEIXIS_KERNEL void ProjectRow(const Rays& rays, const Offset& offset, const std::uint16_t* depth_mm,
                              int width, const Projected& projected) {
  // One coordinate at a time: gcc gives up on vectors where so many arrays may overlap.
  ProjectCoordinate(rays.u, offset.u, rays.z, offset.z, depth_mm, width, projected.u_px);
  ProjectCoordinate(rays.v, offset.v, rays.z, offset.z, depth_mm, width, projected.v_px);
  for (int x = 0; x < width; ++x) {
    const float depth = depth_mm[x];
    const float z = rays.z[x] * depth + offset.z;
    const bool is_seen = (depth > 0.0F) & (z >= kNearest_mm) & (z <= kFarthest_mm);
    projected.z_mm[x] = is_seen ? z : 0.0F;
  }
}

DEIXIS_KERNEL void FindSurface(const float* upper_z_mm, const float* lower_z_mm, int width,
                               std::int32_t* goes_on) {
  for (int x = 0; x + 1 < width; ++x) {
    const float a = upper_z_mm[x], b = upper_z_mm[x + 1];
    const float c = lower_z_mm[x], d = lower_z_mm[x + 1];
    const float nearest = std::min(std::min(a, b), std::min(c, d));
    const float farthest = std::max(std::max(a, b), std::max(c, d));
    const bool is_one = (nearest > 0.0F) & (farthest - nearest <= kSurfaceShare * nearest);
    goes_on[x] = is_one ? 1 : 0;
  }
}

DEIXIS_KERNEL void FindSpans(const Projected& upper, const Projected& lower,
                             const std::int32_t* goes_on, int width, float last_u_px,
                             float last_v_px, const Spans& spans) {
  for (int x = 0; x + 1 < width; ++x) {
    const Span u =
        SpanOf(upper.u_px[x], upper.u_px[x + 1], lower.u_px[x], lower.u_px[x + 1], last_u_px);
    spans.first_u[x] = u.first;
    spans.last_u[x] = goes_on[x] != 0 ? u.last : -1;
  }
  for (int x = 0; x + 1 < width; ++x) {
    const Span v =
        SpanOf(upper.v_px[x], upper.v_px[x + 1], lower.v_px[x], lower.v_px[x + 1], last_v_px);
    spans.first_v[x] = v.first;
    spans.last_v[x] = v.last;
  }
}

}  // namespace deixis::stereo_driver
