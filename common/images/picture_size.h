#pragma once
#include <cstdint>

namespace deixis::images {

/// Pixels of a picture and its longest side: room for 8K video; memory for a few is there, every
/// service is done with one within seconds, and OpenCV works on them. Its remap takes sides below
/// 32767 only, its JPEG encoder up to 65500.
inline constexpr std::int64_t kMostPixels = 40 * 1024 * 1024;
inline constexpr std::int64_t kLongestSide_px = 32766;

/// Whether pictures of that size can go through the whole system.
constexpr bool IsPictureSize(std::int64_t width_px, std::int64_t height_px) {
  return width_px > 0 && height_px > 0 && width_px <= kLongestSide_px &&
         height_px <= kLongestSide_px && width_px * height_px <= kMostPixels;
}

}  // namespace deixis::images
