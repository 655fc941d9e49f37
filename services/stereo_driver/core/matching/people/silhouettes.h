#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

namespace deixis::stereo_driver {

/// Two pictures and the disparities of the left one, all of one size.
struct MatchedPair {
  const cv::Mat& left_bgr;    ///< CV_8UC3
  const cv::Mat& left_grey;   ///< CV_8UC1
  const cv::Mat& right_grey;  ///< CV_8UC1
};

/// Gives back what a near surface has taken of what lies behind it: matchers spread a body's
/// disparity over a band around it. Each pixel of that band is judged by its colour, whether it is
/// rather that of the near surface beyond the band or that of the far one, and, where both cameras
/// see the far one, by how well either disparity suits the right picture.
class SilhouetteSharpener {
 public:
  /// Corrects `disparity` (CV_16SC1, as of DisparityMatcher) in `window` of the pictures. Pixels
  /// given back take the far disparity, or kNoDisparity to the left of a body, where only the left
  /// camera sees what lies behind.
  void Sharpen(const MatchedPair& pair, const cv::Rect& window, cv::Mat& disparity);

 private:
  struct BandPixel {
    cv::Point place;  ///< In the window.
    int near;         ///< Disparities in 1/16 px.
    int far;
    bool is_hidden;  ///< Whether the right camera cannot see the far one.
  };
  void FillHoles(const cv::Mat& disparity);
  void FindBand(const cv::Mat& disparity);
  void AddToBand(cv::Point place, int near);
  float Judged(const MatchedPair& pair, const cv::Rect& window, const BandPixel& pixel) const;
  float MeanJudgement(const BandPixel& pixel) const;

  cv::Mat filled_buffer_, band_buffer_, judged_buffer_, lowest_buffer_;
  cv::Mat filled_;  ///< CV_16SC1, the window's disparities, holes taking the farther neighbour's.
  cv::Mat lowest_;  ///< CV_16SC1, the farthest around.
  cv::Mat band_;    ///< CV_8UC1, 255 in the band.
  cv::Mat judged_;  ///< CV_32FC1, in the band: above 0 = of the near surface.
  std::vector<BandPixel> pixels_;
};

}  // namespace deixis::stereo_driver
