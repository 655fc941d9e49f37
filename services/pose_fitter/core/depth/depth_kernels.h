#pragma once
#include <cstdint>

namespace deixis::pose_fitter {

/// How far neighbouring pixels of one surface may lie apart at depth z:
/// fixed_m + per_m z + per_square_m z^2.
struct StepLimit {
  float fixed_m = 0.0F;
  float per_m = 0.0F;
  float per_square_m = 0.0F;
};

/// Marks in `is_sound` (0 or 1) the pixels of a row that are measured and have no step towards both
/// neighbours of the row, nor towards those above and below. Where the image has no row above or
/// below, zeros are given.
void MarkSoundRow(const float* above_m, const float* row_m, const float* below_m, int width,
                  StepLimit limit, std::uint8_t* is_sound);

}  // namespace deixis::pose_fitter
