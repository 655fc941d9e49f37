#pragma once
#include <opencv2/calib3d.hpp>
#include <opencv2/core/mat.hpp>

#include "common/geometry/stereo_calibration.h"
#include "common/images/stereo_pair.h"
#include "services/stereo_driver/core/matching/disparity.h"

namespace deixis::stereo_driver {

/// OpenCV's matcher as its sample stereo_match sets it.
cv::Ptr<cv::StereoMatcher> PlainMatcher(Method method, int num_disparities);

/// Stereo as OpenCV's samples do it, to compare with: stereoRectify, remap, compute,
/// reprojectImageTo3D.
class PlainOpenCv {
 public:
  /// Only the lenses and how the cameras stand are taken from `calibration`.
  PlainOpenCv(const geometry::StereoCalibration& calibration, Method method, int num_disparities);

  /// Metres along the rectified axis, CV_32FC1, 0 = not measured.
  const cv::Mat& Measure(const images::StereoPair& pair);
  const cv::Mat& depth_m() const { return depth_m_; }  ///< What Measure returned last.

  /// The calibration with this rectification.
  const geometry::StereoCalibration& calibration() const { return calibration_; }

 private:
  geometry::StereoCalibration calibration_;
  cv::Mat left_maps_[2], right_maps_[2];
  cv::Mat reprojection_;
  cv::Ptr<cv::StereoMatcher> matcher_;
  cv::Mat depth_m_;
};

}  // namespace deixis::stereo_driver
