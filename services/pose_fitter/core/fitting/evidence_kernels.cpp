#include "services/pose_fitter/core/fitting/evidence_kernels.h"

#include "common/kernels/kernel.h"

namespace deixis::pose_fitter {

DEIXIS_KERNEL
void MarkRod(const GatedRod& rod, const GatedRow& row, const float* __restrict z_m, int count,
             std::uint8_t* __restrict is_body) {
  const float bx = rod.begin_m[0], by = rod.begin_m[1], bz = rod.begin_m[2];
  const float ax = rod.along_m[0], ay = rod.along_m[1], az = rod.along_m[2];
  const float inverse = rod.inverse_length2, reach0 = rod.reach0_m, change = rod.reach_change_m;
  const float nx = row.floor_normal[0], ny = row.floor_normal[1], nz = row.floor_normal[2];
  for (int i = 0; i < count; ++i) {
    const float z = z_m[i];
    const float x = z * (row.ray_x + static_cast<float>(i) * row.ray_x_per_px);
    const float y = z * row.ray_y;
    const float fx = x - bx, fy = y - by, fz = z - bz;
    float share = (fx * ax + fy * ay + fz * az) * inverse;
    share = share > 0.0F ? share : 0.0F;
    share = share < 1.0F ? share : 1.0F;
    const float dx = fx - share * ax, dy = fy - share * ay, dz = fz - share * az;
    const float reach = reach0 + share * change;
    const bool is_near = dx * dx + dy * dy + dz * dz <= reach * reach;
    const bool is_above = nx * x + ny * y + nz * z > row.lowest_m;
    is_body[i] |= static_cast<std::uint8_t>(((z > 0.0F) & is_near & is_above) ? 1 : 0);
  }
}

}  // namespace deixis::pose_fitter
