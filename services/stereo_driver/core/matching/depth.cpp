#include "services/stereo_driver/core/matching/depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "services/stereo_driver/core/matching/disparity.h"
#include "services/stereo_driver/core/matching/halving.h"

namespace deixis::stereo_driver {
namespace {

constexpr double kLargestDepth_m = 65.535;

std::uint16_t Millimetres(const DepthGeometry& geometry, int disparity) {
  const double z_m = geometry.focal_px * geometry.baseline_m * kDisparityScale / disparity;
  const bool is_inside = z_m >= geometry.nearest_m && z_m <= geometry.farthest_m;
  return is_inside ? static_cast<std::uint16_t>(std::lround(z_m * 1000.0)) : std::uint16_t{0};
}

/// The mean of those of four disparities that agree with the lower middle one of the valid; not
/// positive when none is valid. Halves are rounded up.
int Representative(int a, int b, int c, int d) {
  std::array<int, 4> sorted = {a, b, c, d};
  std::sort(sorted.begin(), sorted.end());
  const auto valid = static_cast<std::size_t>(
      std::count_if(sorted.begin(), sorted.end(), [](int value) { return value > 0; }));
  if (valid == 0) return 0;
  // Of an even number the larger middle: the nearer surface covers the farther one.
  const int middle = sorted[4 - valid + valid / 2];
  int sum = 0;
  int count = 0;
  for (const int value : sorted) {
    const bool agrees = value > 0 && std::abs(value - middle) <= kDisparityScale;
    sum += agrees ? value : 0;
    count += agrees ? 1 : 0;
  }
  return (2 * sum + count) / (2 * count);
}

}  // namespace

DepthConverter::DepthConverter(const DepthGeometry& geometry, int num_disparities)
    : mm_of_disparity_(static_cast<std::size_t>((num_disparities + 1) * kDisparityScale + 1)) {
  const bool is_range = geometry.nearest_m > 0.0 && geometry.farthest_m > geometry.nearest_m &&
                        geometry.farthest_m <= kLargestDepth_m;
  if (!(geometry.focal_px > 0.0) || !(geometry.baseline_m > 0.0) || !is_range) {
    throw std::logic_error("DepthConverter: focal length, baseline or range make no distances");
  }
  for (std::size_t i = 1; i < mm_of_disparity_.size(); ++i) {
    mm_of_disparity_[i] = Millimetres(geometry, static_cast<int>(i));
  }
}

void DepthConverter::Convert(const cv::Mat& disparity, cv::Mat& depth_mm) const {
  depth_mm.create(disparity.size(), CV_16UC1);
  const std::uint16_t* table = mm_of_disparity_.data();
  const int last = static_cast<int>(mm_of_disparity_.size()) - 1;
  for (int y = 0; y < disparity.rows; ++y) {
    const auto* from = disparity.ptr<std::int16_t>(y);
    auto* to = depth_mm.ptr<std::uint16_t>(y);
    for (int x = 0; x < disparity.cols; ++x) to[x] = table[std::clamp<int>(from[x], 0, last)];
  }
}

void DepthConverter::ConvertHalved(const cv::Mat& disparity, cv::Mat& depth_mm) const {
  const Halving rows(disparity.rows);
  const Halving columns(disparity.cols);
  depth_mm.create(rows.half(), columns.half(), CV_16UC1);
  const std::uint16_t* table = mm_of_disparity_.data();
  const int last = static_cast<int>(mm_of_disparity_.size()) - 1;
  for (int y = 0; y < depth_mm.rows; ++y) {
    const auto* upper = disparity.ptr<std::int16_t>(rows.First(y));
    const auto* lower = disparity.ptr<std::int16_t>(rows.First(y) + 1);
    auto* to = depth_mm.ptr<std::uint16_t>(y);
    for (int x = 0; x < depth_mm.cols; ++x) {
      const int i = columns.First(x);
      to[x] = table[std::clamp(Representative(upper[i], upper[i + 1], lower[i], lower[i + 1]), 0,
                               last)];
    }
  }
}

}  // namespace deixis::stereo_driver
