#pragma once
#include <cstdint>

#include "services/pose_fitter/core/depth/depth_kernels.h"

namespace deixis::pose_fitter {

/// When a depth becomes background.
struct BackgroundRule {
  float elapsed_s = 0.0F;
  float still_s = 0.0F;   ///< Seen for so long: known.
  float nearer_s = 0.0F;  ///< Something nearer stays for so long: it is background from now on.
  StepLimit same;         ///< How far the same surface is off from image to image.
};

/// Learns one row. `background_m`: median of what was seen; `seen_s`, `other_s`: for how long that,
/// and for how long something else in a row. Pixels that are not sound, or occupied, teach nothing.
/// `is_occupied` may be null.
void LearnBackgroundRow(const float* row_m, const std::uint8_t* is_sound,
                        const std::uint8_t* is_occupied, int width, const BackgroundRule& rule,
                        float* background_m, float* seen_s, float* other_s);

/// How a row compares with its known background.
struct BackgroundMatch {
  int known = 0;      ///< Sound pixels whose background is known.
  int different = 0;  ///< Of these: that are something else.
};

/// Marks in `is_foreground` (0 or 1) the sound pixels that are not their known background.
BackgroundMatch MarkForegroundRow(const float* row_m, const std::uint8_t* is_sound, int width,
                                  const BackgroundRule& rule, const float* background_m,
                                  const float* seen_s, std::uint8_t* is_foreground);

}  // namespace deixis::pose_fitter
