#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "common/scene/box.h"

namespace deixis::hand_tracker {

/// An image reduced to the size at which it is searched, and the way back to the full pixels.
struct WorkingImage {
  cv::Mat bgr;         ///< CV_8UC3.
  double scale = 1.0;  ///< Full pixels per working pixel, >= 1; the same along both axes.
};

/// Averages `bgr` down so that it is about `width_px` wide; smaller images are taken as they are.
WorkingImage Reduce(const cv::Mat& bgr, int width_px);

/// Origins lie at pixel centres, so that scaling shifts by half a pixel.
inline Eigen::Vector2d ToFull(const Eigen::Vector2d& working, double scale) {
  return ((working.array() + 0.5) * scale - 0.5).matrix();
}
inline Eigen::Vector2d ToWorking(const Eigen::Vector2d& full, double scale) {
  return ((full.array() + 0.5) / scale - 0.5).matrix();
}

scene::Box ToFull(const scene::Box& working, double scale);
scene::Box ToWorking(const scene::Box& full, double scale);

}  // namespace deixis::hand_tracker
