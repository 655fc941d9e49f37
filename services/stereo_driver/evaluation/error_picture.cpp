#include "services/stereo_driver/evaluation/error_picture.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "common/config/config.h"

namespace deixis::stereo_driver {
namespace {

constexpr double kNearest_mm = 1000.0;
constexpr double kFarthest_mm = 5000.0;
constexpr double kWhite_m = 0.1;

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

}  // namespace

void WriteErrorPicture(const std::filesystem::path& folder, const std::string& name,
                       const RectifiedDepth& result, const cv::Mat& errors_m) {
  const std::string path = (folder / ("depth_" + name + ".png")).string();
  cv::Mat picture;
  cv::hconcat(
      std::vector<cv::Mat>{result.left_bgr, ColoursOf(result.depth_mm, result.left_bgr.size()),
                           ColoursOfErrors(errors_m)},
      picture);
  std::filesystem::create_directories(folder);
  if (!cv::imwrite(path, picture)) {
    throw config::ConfigError(path + ": cannot be written; give another --pictures folder");
  }
}

}  // namespace deixis::stereo_driver
