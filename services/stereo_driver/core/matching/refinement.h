#pragma once
#include <opencv2/core/mat.hpp>

#include "common/config/config.h"

namespace deixis::stereo_driver {

struct RefinementConfig {
  int iterations = 3;      ///< Rounds of alignment and smoothing; 0 = as the matcher gave them.
  int window_px = 15;      ///< Side of the blurred window that is aligned, odd.
  int smoothing_px = 7;    ///< Side of the window that agreeing neighbours are averaged in, odd.
  double agree_px = 0.75;  ///< Neighbours within this belong to the same surface.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("iterations", iterations);
    v("window_px", window_px);
    v("smoothing_px", smoothing_px);
    v("agree_px", agree_px);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// Makes disparities more exact than the parabola through three matching costs, which is drawn to
/// whole and half pixels: the pictures themselves are aligned around each pixel by Gauss-Newton
/// steps (Lucas and Kanade 1981, one dimension, weights after Geman-McClure), and neighbours of one
/// surface are averaged. No valid pixel is lost or won, none moves by more than a pixel.
class DisparityRefiner {
 public:
  /// Throws FaultsFound.
  explicit DisparityRefiner(const RefinementConfig& config);

  /// Improves `disparity` (as of DisparityMatcher) of two rectified pictures, CV_8UC1, of its size.
  void Refine(const cv::Mat& left_grey, const cv::Mat& right_grey, cv::Mat& disparity);

  /// The same in a part of the pictures and without rounding: `disparity_px` is CV_32FC1, of the
  /// size of `window`, in pixels, kAbsent_px where there is none. The window lies in the pictures.
  void RefineWindow(const cv::Mat& left_grey, const cv::Mat& right_grey, const cv::Rect& window,
                    cv::Mat& disparity_px);

 private:
  /// Room for `window` in buffers that hold whole pictures, so that windows of changing size cost
  /// no memory.
  void MakeRoom(cv::Size picture, const cv::Rect& window);
  void Run(const cv::Mat& left_grey, const cv::Mat& right_grey, const cv::Rect& window);
  void Align(int first_column);
  void Blur(cv::Mat& values);
  void Smooth();

  RefinementConfig config_;
  cv::Mat buffers_[6];    ///< CV_32FC1, as large as the pictures; the window's below lie in them.
  cv::Mat right_buffer_;  ///< CV_32FC1
  cv::Mat bordered_buffer_;
  cv::Mat left_;          ///< CV_32FC1, grey levels: what kernels gather fastest.
  cv::Mat right_;         ///< CV_32FC1, the window's rows, whole.
  cv::Mat start_px_;      ///< CV_32FC1, as the matcher gave it; kAbsent_px where there is none.
  cv::Mat current_px_;    ///< CV_32FC1
  cv::Mat slope_error_;   ///< CV_32FC1, weighted products of slope and difference.
  cv::Mat slope_square_;  ///< CV_32FC1
  cv::Mat blurred_;       ///< CV_32FC1
  cv::Mat bordered_px_;   ///< CV_32FC1, current_px_ with kAbsent_px around.
};

}  // namespace deixis::stereo_driver
