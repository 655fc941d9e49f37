#include "services/stereo_driver/evaluation/disparity_pair.h"

#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <vector>

#include "common/config/config.h"
#include "services/stereo_driver/core/matching/disparity.h"

namespace deixis::stereo_driver {
namespace {

std::vector<std::string> Split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

cv::Mat Read(const std::string& path, int flags) {
  const cv::Mat picture = cv::imread(path, flags);
  if (picture.empty()) throw config::ConfigError(path + ": cannot be read as a picture");
  return picture;
}

}  // namespace

std::string PairFault(const std::string& text) {
  const std::vector<std::string> parts = Split(text);
  const bool is_pair = parts.size() == 5 && std::atof(parts[4].c_str()) > 0.0;
  return is_pair ? "" : "'" + text + "' is not name,left,right,truth,values per pixel";
}

DisparityPair ReadPair(const std::string& text) {
  const std::vector<std::string> parts = Split(text);
  DisparityPair pair;
  pair.name = parts[0];
  pair.left_bgr = Read(parts[1], cv::IMREAD_COLOR);
  pair.right_bgr = Read(parts[2], cv::IMREAD_COLOR);
  const cv::Mat truth = Read(parts[3], cv::IMREAD_ANYDEPTH | cv::IMREAD_GRAYSCALE);
  if (truth.size() != pair.left_bgr.size() || truth.size() != pair.right_bgr.size()) {
    throw config::ConfigError(parts[3] + ": the truth and the pictures differ in size");
  }
  truth.convertTo(pair.truth_px, CV_32F, 1.0 / std::atof(parts[4].c_str()));
  cv::minMaxLoc(pair.truth_px, nullptr, &pair.largest_px);
  cv::cvtColor(pair.left_bgr, pair.left_grey, cv::COLOR_BGR2GRAY);
  cv::cvtColor(pair.right_bgr, pair.right_grey, cv::COLOR_BGR2GRAY);
  return pair;
}

void Compare(const DisparityPair& pair, const cv::Mat& disparity, const cv::Mat& compared,
             DepthScore& score) {
  for (int y = 0; y < disparity.rows; ++y) {
    for (int x = 0; x < disparity.cols; ++x) {
      const float true_px = pair.truth_px.at<float>(y, x);
      if (true_px <= 0.0F) continue;
      const int sixteenths = disparity.at<std::int16_t>(y, x);
      const double measured_px = static_cast<double>(sixteenths) / kDisparityScale;
      score.AddPixel(true_px, sixteenths > 0 ? std::optional(measured_px) : std::nullopt);
      const bool is_shared = sixteenths > 0 && compared.at<std::int16_t>(y, x) > 0;
      if (is_shared) score.AddShared(true_px, measured_px);
    }
  }
}

}  // namespace deixis::stereo_driver
