#pragma once
#include <cstdint>

namespace deixis::stereo_driver {

/// What turns disparities in pixels into millimetres; others become 0.
struct FineDepthRange {
  float focal_baseline_mm_px;
  float nearest_mm;
  float farthest_mm;
};

/// Half-size disparities in 1/16 px as full-size ones in px, each twice; kAbsent_px where there is
/// none.
void DoubleRow(const std::int16_t* half, int half_width, float* full_px);

/// Distances of a row.
void DepthRow(const float* disparity_px, int width, FineDepthRange range, std::uint16_t* depth_mm);

/// Distances of the means of 2x2 disparities that come from one of half size: they are all there,
/// of one surface, or none is.
void HalvedDepthRow(const float* upper_px, const float* lower_px, int half_width,
                    FineDepthRange range, std::uint16_t* depth_mm);

}  // namespace deixis::stereo_driver
