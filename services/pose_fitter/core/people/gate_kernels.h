#pragma once
#include <cstdint>

#include "services/pose_fitter/core/depth/depth_kernels.h"

namespace deixis::pose_fitter {

/// What a pixel of the gated image is, in bits.
enum PixelLink : std::uint8_t {
  kInside = 1,      ///< May be a person: sound, within range and height.
  kJoinsLeft = 2,   ///< Inside as the pixel to its left, and one surface with it.
  kJoinsAbove = 4,  ///< The same with the pixel above it.
};

/// Where people may be, for one row. Height of depth z in column u above the floor:
/// z (lean + lean_per_px u) + camera_height_m.
struct RowGate {
  float near_m = 0.0F;
  float far_m = 0.0F;
  float lean = 0.0F;
  float lean_per_px = 0.0F;
  float camera_height_m = 0.0F;
  float lowest_m = 0.0F;
  float highest_m = 0.0F;
  float noise_per_square_m = 0.0F;  ///< So many sigmas of a height stay below the lowest.
  StepLimit step;
};

/// Heights of table tops, seats, beds: level pixels there are not inside.
struct Tops {
  static constexpr int kMost = 6;
  float height_m[kMost] = {};
  float tolerance_m = 0.0F;
  int count = 0;
};

/// Marks in `is_level` (0 or 1) the pixels of a row that are inside by range and height and that
/// lie on a level surface with those of either `above_m` or `below_m`, which are `distance_px` rows
/// away: heights that differ by less than a part of what they would on an upright surface.
void MarkLevelRow(const float* above_m, const float* row_m, const float* below_m, int width,
                  const RowGate& gate, float lean_per_row, float pixel_slope, int distance_px,
                  std::uint8_t* is_level);

/// Adds, per centimetre of height, the area of the level pixels of a row as it is seen from above,
/// divided by that of a pixel at 1 m.
void AddLevelArea(const float* row_m, const std::uint8_t* is_level, int width, const RowGate& gate,
                  float* area_per_cm, int bin_count);

/// Leaves in `is_level` those pixels that are on one of `tops`, and marks in `is_inside` (0 or 1)
/// the others of the row that are sound and within range and height.
void GateRow(const float* row_m, const std::uint8_t* is_sound, int width, const RowGate& gate,
             const Tops& tops, std::uint8_t* is_level, std::uint8_t* is_inside);

/// Fills `links` of a row from its depths and those above; `above_inside` of the first row are
/// zeros.
void LinkRow(const float* above_m, const float* row_m, const std::uint8_t* above_inside,
             const std::uint8_t* is_inside, int width, StepLimit step, std::uint8_t* links);

}  // namespace deixis::pose_fitter
