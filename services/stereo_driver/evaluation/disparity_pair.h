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

/// Adds all pixels whose truth is known. `disparity` is CV_16SC1 in 1/16 px, valid when positive.
void Compare(const DisparityPair& pair, const cv::Mat& disparity, DepthScore& score);

}  // namespace deixis::stereo_driver
