#include "services/stereo_driver/core/refinement_kernels.h"

#include <algorithm>
#include <cmath>

namespace deixis::stereo_driver {
namespace {

constexpr float kErrorScale = 12.0F;    // Grey levels at which a difference counts half.
constexpr float kLeastTexture = 20.0F;  // Of slope_square: holds still what has no texture.
constexpr float kLongestStep_px = 0.5F;
constexpr float kLongestWay_px = 1.0F;

}  // namespace

void CompareRow(const std::uint8_t* left, const std::uint8_t* right, const float* disparity_px,
                int width, float* slope_error, float* slope_square) {
  slope_error[0] = slope_square[0] = 0.0F;
  slope_error[width - 1] = slope_square[width - 1] = 0.0F;
  const float last = static_cast<float>(width) - 3.0F;
  for (int x = 1; x < width - 1; ++x) {
    const bool is_present = disparity_px[x] > 0.0F;
    const float place = std::min(std::max(static_cast<float>(x) - disparity_px[x], 1.0F), last);
    const int i = static_cast<int>(place);
    const float share = place - static_cast<float>(i);
    const float r0 = right[i - 1], r1 = right[i], r2 = right[i + 1], r3 = right[i + 2];
    const float error = left[x] - (r1 + share * (r2 - r1));
    const float right_slope = 0.5F * ((r2 - r0) + share * (r3 - r1 - r2 + r0));
    const float left_slope = 0.5F * static_cast<float>(left[x + 1] - left[x - 1]);
    const float slope = 0.5F * (left_slope + right_slope);
    const float scaled = error * (1.0F / kErrorScale);
    const float weight = is_present ? 1.0F / (1.0F + scaled * scaled) : 0.0F;
    slope_error[x] = weight * slope * error;
    slope_square[x] = weight * slope * slope;
  }
}

void StepRow(const float* slope_error, const float* slope_square, const float* start_px, int width,
             float* disparity_px) {
  for (int x = 0; x < width; ++x) {
    const float step = -slope_error[x] / (slope_square[x] + kLeastTexture);
    const float moved =
        disparity_px[x] + std::min(std::max(step, -kLongestStep_px), kLongestStep_px);
    const float held =
        std::min(std::max(moved, start_px[x] - kLongestWay_px), start_px[x] + kLongestWay_px);
    disparity_px[x] = start_px[x] > 0.0F ? held : kAbsent_px;
  }
}

void SmoothRow(const float* rows, std::int64_t stride, int side, float agree_px, int width,
               float* smoothed_px) {
  const std::int64_t middle = side / 2 * stride + side / 2;
  for (int x = 0; x < width; ++x) {
    const float here = rows[x + middle];
    float sum = 0.0F;
    float count = 0.0F;
    for (int dy = 0; dy < side; ++dy) {
      const float* window = rows + dy * stride + x;
      for (int dx = 0; dx < side; ++dx) {
        const float difference = window[dx] - here;
        const float agrees = std::abs(difference) < agree_px ? 1.0F : 0.0F;
        sum += agrees * difference;
        count += agrees;
      }
    }
    smoothed_px[x] = here + sum / count;
  }
}

}  // namespace deixis::stereo_driver
