#include "services/stereo_driver/evaluation/rendered_truth.h"

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "services/stereo_driver/core/calibration/camera_matrix.h"

namespace deixis::stereo_driver {
namespace {

constexpr float kNoBody = -1.0F;
constexpr float kNotMeasured = -2.0F;
constexpr float kEdge_px = 4.0F;       // How far from a body's edge fattening is looked for.
constexpr double kLeastStep_m = 0.15;  // From a body to what lies behind it.

std::optional<double> DepthAt(const cv::Mat& depth, double unit_m, double u, double v) {
  const auto x = static_cast<int>(std::floor(u));
  const auto y = static_cast<int>(std::floor(v));
  if (x < 0 || y < 0 || x >= depth.cols || y >= depth.rows) return std::nullopt;
  const double value =
      depth.type() == CV_16UC1 ? depth.at<std::uint16_t>(y, x) : depth.at<float>(y, x);
  return value > 0.0 ? std::optional(value * unit_m) : std::nullopt;
}

/// For the pixels around bodies, which body pixel is the nearest.
class NearestBody {
 public:
  explicit NearestBody(const cv::Mat& is_body) {
    cv::distanceTransform(~is_body, distance_px_, labels_, cv::DIST_L2, cv::DIST_MASK_5,
                          cv::DIST_LABEL_PIXEL);
    for (int y = 0; y < is_body.rows; ++y) {
      for (int x = 0; x < is_body.cols; ++x) {
        if (is_body.at<std::uint8_t>(y, x) != 0) NoteBody(x, y);
      }
    }
  }

  /// Nothing farther than kEdge_px from all bodies, and on them.
  std::optional<cv::Point> To(int x, int y) const {
    const float distance_px = distance_px_.at<float>(y, x);
    if (distance_px <= 0.0F || distance_px > kEdge_px) return std::nullopt;
    return pixels_[static_cast<std::size_t>(labels_.at<int>(y, x))];
  }

 private:
  void NoteBody(int x, int y) {
    const auto label = static_cast<std::size_t>(labels_.at<int>(y, x));
    if (pixels_.size() <= label) pixels_.resize(label + 1);
    pixels_[label] = {x, y};
  }

  cv::Mat distance_px_;              ///< CV_32FC1
  cv::Mat labels_;                   ///< CV_32SC1
  std::vector<cv::Point> pixels_{};  ///< By label.
};

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

std::optional<double> RenderedTruth::MeasuredAt(const cv::Mat& depth, double unit_m,
                                                const cv::Vec3d& ray) const {
  const double u = rectified_.focal_px.x() * ray[0] / ray[2] + rectified_.principal_point_px.x();
  const double v = rectified_.focal_px.y() * ray[1] / ray[2] + rectified_.principal_point_px.y();
  // Columns and rows start half a pixel before the first centre, whatever the size.
  return DepthAt(depth, unit_m, (u + 0.5) * depth.cols / rectified_.width_px,
                 (v + 0.5) * depth.rows / rectified_.height_px);
}

cv::Mat RenderedTruth::Compare(const TrueFrame& frame, const cv::Mat& depth, double unit_m,
                               DepthScore& score) const {
  cv::Mat errors_m(rays_.size(), CV_32FC1, cv::Scalar(kNoBody));
  for (int y = 0; y < rays_.rows; ++y) {
    for (int x = 0; x < rays_.cols; ++x) {
      const double raw_m = frame.depth_mm.at<std::uint16_t>(y, x) / 1000.0;
      if (frame.is_body.at<std::uint8_t>(y, x) == 0 || raw_m <= 0.0) continue;
      const cv::Vec3d& ray = rays_.at<cv::Vec3d>(y, x);
      const auto measured_m = MeasuredAt(depth, unit_m, ray);
      const double true_m = raw_m * ray[2];
      score.AddPixel(focal_baseline_, true_m, measured_m);
      errors_m.at<float>(y, x) =
          measured_m ? static_cast<float>(std::abs(*measured_m - true_m)) : kNotMeasured;
    }
  }
  CompareAroundBodies(frame, depth, unit_m, score);
  return errors_m;
}

void RenderedTruth::CompareAroundBodies(const TrueFrame& frame, const cv::Mat& depth, double unit_m,
                                        DepthScore& score) const {
  const NearestBody nearest(frame.is_body);
  for (int y = 0; y < rays_.rows; ++y) {
    for (int x = 0; x < rays_.cols; ++x) {
      const auto body = nearest.To(x, y);
      if (!body) continue;
      const cv::Vec3d& ray = rays_.at<cv::Vec3d>(y, x);
      const double body_m = frame.depth_mm.at<std::uint16_t>(*body) / 1000.0 * ray[2];
      const double true_m = frame.depth_mm.at<std::uint16_t>(y, x) / 1000.0 * ray[2];
      if (body_m <= 0.0 || true_m < body_m + kLeastStep_m) continue;
      score.AddBesideBody(body_m, true_m, MeasuredAt(depth, unit_m, ray));
    }
  }
}

}  // namespace deixis::stereo_driver
