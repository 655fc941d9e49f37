#pragma once
#include <opencv2/core/mat.hpp>

#include "common/images/encoded_image.h"

namespace deixis::images {

/// A rectified picture and the depth of the same view: what travels on STEREO.
struct StereoImage {
  EncodedImage left;  ///< Carries time and camera of both.
  cv::Mat depth_mm;   ///< CV_16UC1, millimetres along the optical axis, 0 = not measured; its size
                      ///< may be another one than the picture's: it covers the same view.
};

}  // namespace deixis::images
