#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "services/stereo_driver/core/matching/depth.h"
#include "services/stereo_driver/core/matching/people/people_config.h"
#include "services/stereo_driver/core/matching/people/silhouettes.h"
#include "services/stereo_driver/core/matching/people/standing_out.h"
#include "services/stereo_driver/core/matching/people/windows.h"
#include "services/stereo_driver/core/matching/rectifier.h"
#include "services/stereo_driver/core/matching/refinement.h"

namespace deixis::stereo_driver {

/// Measures at full size where people can be, starting from disparities of half size: windows
/// around them are aligned in the full-size pictures. Since no pixel moves by more than a full-size
/// pixel from where half size has put it, there is no seam around a window.
class PeopleMeasurer {
 public:
  /// `half` is what turns half-size disparities into distances. Throws FaultsFound.
  PeopleMeasurer(const PeopleConfig& config, const DepthGeometry& half);

  /// `said` are windows where people have been said to be, as they come; empty = nobody is known,
  /// and what stands out is taken. `half_disparity` is sharpened in the windows. Pictures of odd
  /// size have no windows.
  void Measure(const Windows& said, const RectifiedPair& pair, const cv::Mat& half_left_grey,
               const cv::Mat& half_right_grey, cv::Mat& half_disparity);

  /// Puts the measured windows into `depth_mm`, CV_16UC1 of full or half size.
  void WriteTo(cv::Mat& depth_mm) const;

  /// Those that were measured last, in pixels of the full-size picture.
  const Windows& windows() const { return windows_; }

 private:
  void Sharpen(const RectifiedPair& pair, const cv::Mat& half_left_grey,
               const cv::Mat& half_right_grey, cv::Mat& half_disparity);
  void Align(const RectifiedPair& pair, const cv::Rect& window, const cv::Mat& half_disparity);

  PeopleConfig config_;
  DepthGeometry half_;
  StandingOut standing_out_;
  SilhouetteSharpener sharpener_;
  DisparityRefiner refiner_;
  Windows windows_;
  cv::Mat half_bgr_;
  cv::Mat disparity_px_;  ///< CV_32FC1, full size; holds what is in the windows.
};

}  // namespace deixis::stereo_driver
