#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace deixis::skin {

/// Probability (0..255) that a colour is skin, by its blue, green and red values in steps of 8.
/// Index: (blue >> 3) << 10 | (green >> 3) << 5 | red >> 3.
using SkinTable = std::array<std::uint8_t, std::size_t{32} * 32 * 32>;

/// Looks every pixel of `bgr` (CV_8UC3) up. Returns a CV_8UC1 picture of the same size.
cv::Mat Classify(const cv::Mat& bgr, const SkinTable& table);

}  // namespace deixis::skin
