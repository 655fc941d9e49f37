#pragma once
#include <algorithm>
#include <cmath>
#include <opencv2/core/mat.hpp>

#include "common/images/encoded_image.h"

namespace deixis::images {

/// A rectified picture and the depth of the same view: what travels on STEREO.
struct StereoImage {
  EncodedImage left;  ///< Carries time and camera of both.
  cv::Mat depth_mm;   ///< CV_16UC1, millimetres along the optical axis, 0 = not measured; its size
                      ///< may be another one than the picture's: it covers the same view.
};

/// Whether depth of one size may cover the view of a picture of another: their aspects differ by no
/// more than 2 % and half a pixel, which rounding takes from either side of a picture made smaller.
inline bool MayCoverSameView(cv::Size depth, cv::Size picture) {
  constexpr double kTolerance = 0.02;
  const double wide = 1.0 * depth.width * picture.height;
  const double high = 1.0 * depth.height * picture.width;
  const double rounding = 0.5 * std::max(picture.width, picture.height);
  return std::abs(wide - high) <= kTolerance * high + rounding;
}

}  // namespace deixis::images
