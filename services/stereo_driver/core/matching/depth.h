#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace deixis::stereo_driver {

/// What turns disparities into distances.
struct DepthGeometry {
  double focal_px = 0.0;    ///< Of the pictures that were matched.
  double baseline_m = 0.0;  ///< Between the cameras.
  double nearest_m = 0.0;   ///< Nearer ones become 0.
  double farthest_m = 0.0;  ///< Farther ones become 0; at most 65.535.
};

/// z = f b / d, from CV_16SC1 in 1/16 px to CV_16UC1 in millimetres, rounded to the nearest; what
/// is not positive or out of range becomes 0.
class DepthConverter {
 public:
  /// Disparities up to `num_disparities` px occur. Throws std::logic_error on values that make no
  /// distances.
  DepthConverter(const DepthGeometry& geometry, int num_disparities);

  /// Pixel by pixel, into `depth_mm`, whose memory is used again.
  void Convert(const cv::Mat& disparity, cv::Mat& depth_mm) const;

  /// Half as wide and high, of the same view (see Halving). Each pixel stands for 2x2
  /// disparities: the mean of those that agree within a pixel with the nearest to the middle of the
  /// valid ones, so that no distance is made up between a body and what lies behind it.
  void ConvertHalved(const cv::Mat& disparity, cv::Mat& depth_mm) const;

 private:
  std::vector<std::uint16_t> mm_of_disparity_;  ///< By disparity in 1/16 px; 0 and above.
};

}  // namespace deixis::stereo_driver
