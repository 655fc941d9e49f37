#pragma once
#include <cstdint>

namespace deixis::pose_fitter {

/// A limb as a rod with a radius that changes evenly, and a gate about it, in the camera's frame.
struct GatedRod {
  float begin_m[3];
  float along_m[3];       ///< To its other end.
  float inverse_length2;  ///< 1 / |along|^2.
  float reach0_m;         ///< Radius at the beginning, and the gate.
  float reach_change_m;   ///< From there to the other end.
};

/// Pixels of one row whose rays are (ray_x + i ray_x_per_px, ray_y, 1), and the floor's plane.
struct GatedRow {
  float ray_x, ray_x_per_px, ray_y;
  float floor_normal[3];
  float lowest_m;  ///< What lies lower than this along the normal is the floor's.
};

/// Sets `is_body` (0 or 1) where the depth `z_m` (0 = not measured) is within the rod's gate and
/// above the floor; leaves it as it is elsewhere.
void MarkRod(const GatedRod& rod, const GatedRow& row, const float* z_m, int count,
             std::uint8_t* is_body);

}  // namespace deixis::pose_fitter
