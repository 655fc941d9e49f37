#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

#include "common/time/timestamp.h"

namespace deixis::images {

/// One picture of a camera, decoded.
struct Image {
  Timestamp time;      ///< Capture time.
  std::string camera;  ///< Which camera or published picture the pixels belong to.
  cv::Mat bgr;  ///< rows x cols, CV_8UC3, order blue green red; never empty in a valid image.
};

}  // namespace deixis::images
