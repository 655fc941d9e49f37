#include "services/hand_tracker/core/working_image.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace deixis::hand_tracker {
namespace {

scene::Box Scaled(const scene::Box& box, double factor, const Eigen::Vector2d& corner) {
  return {corner.x(), corner.y(), box.width_px * factor, box.height_px * factor};
}

}  // namespace

WorkingImage Reduce(const cv::Mat& bgr, int width_px) {
  WorkingImage working;
  working.scale = std::max(1.0, static_cast<double>(bgr.cols) / width_px);
  if (working.scale == 1.0) {
    working.bgr = bgr;
    return working;
  }
  const cv::Size size(width_px,
                      std::max(1, static_cast<int>(std::lround(bgr.rows / working.scale))));
  cv::resize(bgr, working.bgr, size, 0.0, 0.0, cv::INTER_AREA);
  return working;
}

scene::Box ToFull(const scene::Box& working, double scale) {
  return Scaled(working, scale, ToFull(Eigen::Vector2d(working.x_px, working.y_px), scale));
}

scene::Box ToWorking(const scene::Box& full, double scale) {
  return Scaled(full, 1.0 / scale, ToWorking(Eigen::Vector2d(full.x_px, full.y_px), scale));
}

}  // namespace deixis::hand_tracker
