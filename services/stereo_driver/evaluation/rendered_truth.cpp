#include "services/stereo_driver/evaluation/rendered_truth.h"

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "services/stereo_driver/core/calibration/camera_matrix.h"

namespace deixis::stereo_driver {
namespace {

constexpr float kNoBody = -1.0F;
constexpr float kNotMeasured = -2.0F;

std::optional<double> DepthAt(const cv::Mat& depth, double unit_m, double u, double v) {
  const auto x = static_cast<int>(std::floor(u));
  const auto y = static_cast<int>(std::floor(v));
  if (x < 0 || y < 0 || x >= depth.cols || y >= depth.rows) return std::nullopt;
  const double value =
      depth.type() == CV_16UC1 ? depth.at<std::uint16_t>(y, x) : depth.at<float>(y, x);
  return value > 0.0 ? std::optional(value * unit_m) : std::nullopt;
}

}  // namespace

RenderedTruth::RenderedTruth(const geometry::StereoCalibration& calibration)
    : rectified_(calibration.rectified),
      focal_baseline_(calibration.rectified.focal_px.x() *
                      calibration.right_from_left.translation_m.norm()) {
  const geometry::CameraCalibration& left = calibration.left;
  std::vector<cv::Point2d> pixels;
  for (int y = 0; y < left.height_px; ++y) {
    for (int x = 0; x < left.width_px; ++x) pixels.emplace_back(x, y);
  }
  std::vector<cv::Point2d> straight;
  cv::undistortPoints(pixels, straight, CameraMatrix(left), left.distortion, cv::noArray(),
                      cv::noArray());
  rays_.create(left.height_px, left.width_px, CV_64FC3);
  for (int i = 0; i < static_cast<int>(straight.size()); ++i) {
    const Eigen::Vector3d ray =
        left.rectification * Eigen::Vector3d(straight[static_cast<std::size_t>(i)].x,
                                             straight[static_cast<std::size_t>(i)].y, 1.0);
    rays_.at<cv::Vec3d>(i / left.width_px, i % left.width_px) = {ray.x(), ray.y(), ray.z()};
  }
}

cv::Mat RenderedTruth::Compare(const TrueFrame& frame, const cv::Mat& depth, double unit_m,
                               DepthScore& score) const {
  cv::Mat errors_m(rays_.size(), CV_32FC1, cv::Scalar(kNoBody));
  const double scale_x = static_cast<double>(depth.cols) / rectified_.width_px;
  const double scale_y = static_cast<double>(depth.rows) / rectified_.height_px;
  for (int y = 0; y < rays_.rows; ++y) {
    for (int x = 0; x < rays_.cols; ++x) {
      const double raw_m = frame.depth_mm.at<std::uint16_t>(y, x) / 1000.0;
      if (frame.is_body.at<std::uint8_t>(y, x) == 0 || raw_m <= 0.0) continue;
      const cv::Vec3d& ray = rays_.at<cv::Vec3d>(y, x);
      const double u =
          rectified_.focal_px.x() * ray[0] / ray[2] + rectified_.principal_point_px.x();
      const double v =
          rectified_.focal_px.y() * ray[1] / ray[2] + rectified_.principal_point_px.y();
      // Columns and rows start half a pixel before the first centre, whatever the size.
      const auto measured_m = DepthAt(depth, unit_m, (u + 0.5) * scale_x, (v + 0.5) * scale_y);
      const double true_m = raw_m * ray[2];
      score.AddPixel(focal_baseline_, true_m, measured_m);
      errors_m.at<float>(y, x) =
          measured_m ? static_cast<float>(std::abs(*measured_m - true_m)) : kNotMeasured;
    }
  }
  return errors_m;
}

}  // namespace deixis::stereo_driver
