#pragma once
#include <opencv2/core/mat.hpp>

#include "common/geometry/camera_calibration.h"

namespace deixis::stereo_driver {

/// The 3x3 matrix of OpenCV, CV_64F.
inline cv::Mat CameraMatrix(const geometry::CameraCalibration& lens) {
  return (cv::Mat_<double>(3, 3) << lens.focal_px.x(), 0.0, lens.principal_point_px.x(), 0.0,
          lens.focal_px.y(), lens.principal_point_px.y(), 0.0, 0.0, 1.0);
}

}  // namespace deixis::stereo_driver
