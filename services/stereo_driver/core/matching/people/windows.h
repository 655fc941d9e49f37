#pragma once
#include <opencv2/core/types.hpp>
#include <vector>

namespace deixis::stereo_driver {

/// Parts of a picture, for work that need not be done everywhere. Corners are made even, so that a
/// half-size picture has the same windows.
using Windows = std::vector<cv::Rect>;

/// The same parts, the most important ones first, as windows that lie in a picture of `size`, do
/// not overlap and are not larger than `largest_share` of it together: of two that overlap the
/// second becomes part of the first when they fill a rectangle well, else what is left of it beside
/// the first stays, and what finds no room is left out.
Windows Tidied(const Windows& windows, cv::Size size, double largest_share);

}  // namespace deixis::stereo_driver
