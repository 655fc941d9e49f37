#include "services/stereo_driver/core/matching/refinement_kernels.h"

#include <algorithm>
#include <cmath>

#include "common/kernels/kernel.h"

namespace deixis::stereo_driver {
namespace {

constexpr float kErrorScale = 12.0F;    // Grey levels at which a difference counts half.
constexpr float kLeastTexture = 20.0F;  // Of slope_square: holds still what has no texture.
constexpr float kLongestStep_px = 0.5F;
constexpr float kLongestWay_px = 1.0F;

constexpr int kBlock = 256;  // Sums of so many pixels stay in the nearest cache.
// Neighbours of a row that are added in registers: the usual windows'.
constexpr int kTogether = 7;
constexpr int kMoreTogether = 9;

/// Adds, to sum and count, those of `kCount` neighbours that agree with `here`.
template <int kCount>
[[gnu::always_inline]] inline void AddAgreeing(const float* others, const float* here,
                                               float agree_px, int width, float* sum,
                                               float* count) {
  for (int x = 0; x < width; ++x) {
    float sum_here = sum[x];
    float count_here = count[x];
    for (int dx = 0; dx < kCount; ++dx) {
      const float difference = others[x + dx] - here[x];
      const float agrees = std::abs(difference) < agree_px ? 1.0F : 0.0F;
      sum_here += agrees * difference;
      count_here += agrees;
    }
    sum[x] = sum_here;
    count[x] = count_here;
  }
}

[[gnu::always_inline]] inline void SmoothBlock(const float* rows, std::int64_t stride, int side,
                                               float agree_px, int width, float* smoothed_px) {
  float sum[kBlock];
  float count[kBlock];
  for (int x = 0; x < width; ++x) sum[x] = count[x] = 0.0F;  // With {}, GCC 12 makes no vectors.
  const float* here = rows + side / 2 * stride + side / 2;
  for (int dy = 0; dy < side; ++dy) {
    const float* row = rows + dy * stride;
    int dx = 0;
    for (; dx + kMoreTogether == side; dx += kMoreTogether) {
      AddAgreeing<kMoreTogether>(row, here, agree_px, width, sum, count);
    }
    for (; dx + kTogether <= side; dx += kTogether) {
      AddAgreeing<kTogether>(row + dx, here, agree_px, width, sum, count);
    }
    for (; dx < side; ++dx) AddAgreeing<1>(row + dx, here, agree_px, width, sum, count);
  }
  for (int x = 0; x < width; ++x) smoothed_px[x] = here[x] + sum[x] / count[x];
}

}  // namespace

DEIXIS_KERNEL void CompareRow(const float* left, RightRow right, const float* disparity_px,
                              int width, float* slope_error, float* slope_square) {
  slope_error[0] = slope_square[0] = 0.0F;
  slope_error[width - 1] = slope_square[width - 1] = 0.0F;
  const float* grey = right.grey;
  const float first = static_cast<float>(right.first);
  const float last = static_cast<float>(right.width) - 3.0F;
  for (int x = 1; x < width - 1; ++x) {
    const bool is_present = disparity_px[x] > 0.0F;
    const float place =
        std::min(std::max(first + static_cast<float>(x) - disparity_px[x], 1.0F), last);
    const int i = static_cast<int>(place);
    const float share = place - static_cast<float>(i);
    const float r0 = grey[i - 1], r1 = grey[i], r2 = grey[i + 1], r3 = grey[i + 2];
    const float error = left[x] - (r1 + share * (r2 - r1));
    const float right_slope = 0.5F * ((r2 - r0) + share * (r3 - r1 - r2 + r0));
    const float left_slope = 0.5F * (left[x + 1] - left[x - 1]);
    const float slope = 0.5F * (left_slope + right_slope);
    const float scaled = error * (1.0F / kErrorScale);
    const float likeness = 1.0F / (1.0F + scaled * scaled);
    const float weight = is_present ? likeness * likeness : 0.0F;
    slope_error[x] = weight * slope * error;
    slope_square[x] = weight * slope * slope;
  }
}

DEIXIS_KERNEL void StepRow(const float* slope_error, const float* slope_square,
                           const float* start_px, int width, float* disparity_px) {
  for (int x = 0; x < width; ++x) {
    const float step = -slope_error[x] / (slope_square[x] + kLeastTexture);
    const float moved =
        disparity_px[x] + std::min(std::max(step, -kLongestStep_px), kLongestStep_px);
    const float held =
        std::min(std::max(moved, start_px[x] - kLongestWay_px), start_px[x] + kLongestWay_px);
    disparity_px[x] = start_px[x] > 0.0F ? held : kAbsent_px;
  }
}

DEIXIS_KERNEL void SmoothRow(const float* rows, std::int64_t stride, int side, float agree_px,
                             int width, float* smoothed_px) {
  for (int start = 0; start < width; start += kBlock) {
    SmoothBlock(rows + start, stride, side, agree_px, std::min(kBlock, width - start),
                smoothed_px + start);
  }
}

}  // namespace deixis::stereo_driver
