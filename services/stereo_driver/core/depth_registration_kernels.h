#pragma once
#include <cstdint>

namespace deixis::stereo_driver {

/// Neighbours of one surface differ in distance by less, as a share of the distance.
constexpr float kSurfaceShare = 0.03F;

/// Of a row of pixels: their rays times the rotation and the camera matrix of the target.
struct Rays {
  const float* u = nullptr;
  const float* v = nullptr;
  const float* z = nullptr;
};

/// The translation times the target's camera matrix, millimetres.
struct Offset {
  float u = 0.0F;
  float v = 0.0F;
  float z = 0.0F;
};

/// Where the pixels of a row lie in the target.
struct Projected {
  float* u_px = nullptr;
  float* v_px = nullptr;
  float* z_mm = nullptr;  ///< Along the target's optical axis; 0 = not measured, or not before it.
};

void ProjectRow(const Rays& rays, const Offset& offset, const std::uint16_t* depth_mm, int width,
                const Projected& projected);

/// For each of `width - 1` places between pixels x and x + 1 of two rows: 1 where all four are
/// measured and belong to one surface.
void FindSurface(const float* upper_z_mm, const float* lower_z_mm, int width,
                 std::uint8_t* goes_on);

}  // namespace deixis::stereo_driver
