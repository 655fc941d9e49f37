#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>

#include "common/geometry/stereo_calibration.h"
#include "services/stereo_driver/evaluation/depth_score.h"
#include "services/stereo_driver/evaluation/rendered_sequence.h"

namespace deixis::stereo_driver {

/// Where pixels of the raw left camera lie in a rectified depth image, and how far.
class RenderedTruth {
 public:
  explicit RenderedTruth(const geometry::StereoCalibration& calibration);

  /// Adds all body pixels of `frame`, and those beside bodies that see farther things. `depth`
  /// covers the rectified view in any size, in `unit_m`, CV_16UC1 or CV_32FC1, 0 = not measured.
  /// Returns the absolute errors, CV_32FC1 in metres, -1 where there is no body and -2 where a body
  /// was not measured, on the raw left pixels.
  cv::Mat Compare(const TrueFrame& frame, const cv::Mat& depth, double unit_m,
                  DepthScore& score) const;

 private:
  std::optional<double> MeasuredAt(const cv::Mat& depth, double unit_m, const cv::Vec3d& ray) const;
  void CompareAroundBodies(const TrueFrame& frame, const cv::Mat& depth, double unit_m,
                           DepthScore& score) const;

  geometry::CameraCalibration rectified_;
  double focal_baseline_;
  cv::Mat rays_;  ///< CV_64FC3: the point of the rectified frame at z = 1 m of the raw one.
};

}  // namespace deixis::stereo_driver
