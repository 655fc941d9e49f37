#include "services/stereo_driver/evaluation/error_picture.h"

#include <algorithm>
#include <cstdio>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "common/config/config.h"

namespace deixis::stereo_driver {
namespace {

constexpr double kNearest_mm = 1000.0;
constexpr double kFarthest_mm = 5000.0;
constexpr double kWhite_m = 0.1;
constexpr int kCaption_px = 24;  // Height of the strip below a panel.
constexpr int kMargin_px = 6;
constexpr double kLargestFont = 0.5;  // As cv::putText has it.

cv::Mat ColoursOf(const cv::Mat& depth_mm, cv::Size size) {
  cv::Mat grey, colours;
  const double scale = -255.0 / (kFarthest_mm - kNearest_mm);
  depth_mm.convertTo(grey, CV_8U, scale, -scale * kFarthest_mm);
  cv::applyColorMap(grey, colours, cv::COLORMAP_JET);
  colours.setTo(cv::Scalar::all(0), depth_mm == 0);
  cv::resize(colours, colours, size, 0.0, 0.0, cv::INTER_NEAREST);
  return colours;
}

cv::Mat ColoursOfErrors(const cv::Mat& errors_m) {
  cv::Mat grey, colours;
  errors_m.convertTo(grey, CV_8U, 255.0 / kWhite_m);
  cv::cvtColor(grey, colours, cv::COLOR_GRAY2BGR);
  colours.setTo(cv::Scalar(80, 40, 0), errors_m == -1.0F);
  colours.setTo(cv::Scalar(0, 0, 255), errors_m == -2.0F);
  return colours;
}

std::string Metres(double metres) {
  char text[16];
  std::snprintf(text, sizeof text, "%g m", metres);
  return text;
}

std::string DepthCaption() {
  return "depth: red " + Metres(kNearest_mm / 1000.0) + " or nearer to blue " +
         Metres(kFarthest_mm / 1000.0) + " or farther; black = none";
}

std::string ErrorCaption() {
  return "error of depth: black 0 to white " + Metres(kWhite_m) +
         " or more; red = body not measured; blue = no body";
}

/// `panel` with a line of text below it, made as small as its width demands.
cv::Mat Captioned(const cv::Mat& panel, const std::string& caption) {
  constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
  const int width = cv::getTextSize(caption, kFont, 1.0, 1, nullptr).width;
  const double scale = std::min(kLargestFont, (panel.cols - 2.0 * kMargin_px) / width);
  cv::Mat captioned;
  cv::copyMakeBorder(panel, captioned, 0, kCaption_px, 0, 0, cv::BORDER_CONSTANT,
                     cv::Scalar::all(255));
  cv::putText(captioned, caption, {kMargin_px, captioned.rows - kCaption_px / 3}, kFont, scale,
              cv::Scalar::all(0), 1, cv::LINE_AA);
  return captioned;
}

}  // namespace

void WriteErrorPicture(const std::filesystem::path& folder, const std::string& name,
                       const RectifiedDepth& result, const cv::Mat& errors_m) {
  const std::string path = (folder / ("depth_" + name + ".png")).string();
  cv::Mat picture;
  const cv::Mat depth = ColoursOf(result.depth_mm, result.left_bgr.size());
  cv::hconcat(std::vector<cv::Mat>{Captioned(result.left_bgr, "rectified left picture"),
                                   Captioned(depth, DepthCaption()),
                                   Captioned(ColoursOfErrors(errors_m), ErrorCaption())},
              picture);
  std::filesystem::create_directories(folder);
  if (!cv::imwrite(path, picture)) {
    throw config::ConfigError(path + ": cannot be written; give another --pictures folder");
  }
}

}  // namespace deixis::stereo_driver
