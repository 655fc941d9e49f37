#pragma once
#include <opencv2/core/mat.hpp>

#include "common/time/timestamp.h"

namespace deixis::object_detector {

/// A picture as detectors see it.
struct GreyPicture {
  Timestamp time;
  cv::Mat grey;  ///< rows x cols, CV_8UC1.
};

}  // namespace deixis::object_detector
