#pragma once
#include <cstdint>

namespace deixis::stereo_driver {

/// Stands for a disparity that is absent: far from all others. Pixels.
constexpr float kAbsent_px = -1e4F;

/// A row of the right picture, of which pixels of the left one may start at another column.
struct RightRow {
  const float* grey;  ///< From column 0 of the picture.
  int width;
  int first;  ///< Column of the left picture's first pixel.
};

/// For each pixel of a row: the difference of the left picture and the right one moved by
/// `disparity_px`, times their mean slope, and that slope squared, both weighted down where they
/// differ much. 0 where the disparity is absent.
void CompareRow(const float* left, RightRow right, const float* disparity_px, int width,
                float* slope_error, float* slope_square);

/// One step towards the least squared difference, at most half a pixel long, and never further than
/// a pixel from `start_px`.
void StepRow(const float* slope_error, const float* slope_square, const float* start_px, int width,
             float* disparity_px);

/// The mean of those of a `side` x `side` window that lie within `agree_px` of its middle. `rows`
/// is the window's top row at the left end of the first window; rows are `stride` apart.
void SmoothRow(const float* rows, std::int64_t stride, int side, float agree_px, int width,
               float* smoothed_px);

}  // namespace deixis::stereo_driver
