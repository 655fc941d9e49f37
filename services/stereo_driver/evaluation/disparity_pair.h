#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

#include "services/stereo_driver/evaluation/depth_score.h"

namespace deixis::stereo_driver {

/// A rectified pair whose disparity is known.
struct DisparityPair {
  std::string name;
  cv::Mat left_bgr, right_bgr;
  cv::Mat left_grey, right_grey;
  cv::Mat truth_px;         ///< CV_32FC1, 0 = not known.
  double largest_px = 0.0;  ///< Of truth_px.
};

/// What is wrong with a command line's "name,left,right,truth,scale"; empty when nothing is.
std::string PairFault(const std::string& text);

/// Reads what such a text names. Throws ConfigError naming the file that cannot be read.
DisparityPair ReadPair(const std::string& text);

/// Adds all pixels whose truth is known. Disparities are CV_16SC1 in 1/16 px, valid when positive;
/// `compared` is another way's, which says what pixels both have measured.
void Compare(const DisparityPair& pair, const cv::Mat& disparity, const cv::Mat& compared,
             DepthScore& score);

}  // namespace deixis::stereo_driver
