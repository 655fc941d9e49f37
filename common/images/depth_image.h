#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

#include "common/time/timestamp.h"

namespace deixis::images {

/// Distances along the optical axis (z, not the length of the ray).
struct DepthImage {
  Timestamp time;      ///< Capture time.
  std::string camera;  ///< Whose view it is.
  cv::Mat depth_mm;    ///< rows x cols, CV_16UC1, millimetres; 0 = not measured.
};

}  // namespace deixis::images
