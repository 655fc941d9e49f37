#include "common/geometry/camera_calibration.h"

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <stdexcept>

namespace deixis::geometry {
namespace {

std::vector<cv::Point2d> ProjectWithLens(const CameraCalibration& calibration,
                                         const Eigen::Vector3d& point) {
  const std::vector<cv::Point3d> points{{point.x(), point.y(), point.z()}};
  const cv::Matx33d matrix(calibration.focal_px.x(), 0, calibration.principal_point_px.x(), 0,
                           calibration.focal_px.y(), calibration.principal_point_px.y(), 0, 0, 1);
  const cv::Vec3d none(0, 0, 0);
  std::vector<cv::Point2d> pixels;
  if (calibration.distortion_model == DistortionModel::kFisheye) {
    cv::fisheye::projectPoints(points, pixels, none, none, matrix, calibration.distortion);
  } else {
    cv::projectPoints(points, none, none, matrix, calibration.distortion, pixels);
  }
  return pixels;
}

}  // namespace

CameraCalibration GuessCalibration(int width_px, int height_px, double horizontal_fov_rad) {
  if (width_px <= 0 || height_px <= 0) throw std::invalid_argument("image size must be positive");
  if (!(horizontal_fov_rad > 0.0 && horizontal_fov_rad < M_PI)) {
    throw std::invalid_argument("horizontal field of view must lie between 0 and pi rad");
  }
  CameraCalibration calibration;
  calibration.width_px = width_px;
  calibration.height_px = height_px;
  const double focal_px = 0.5 * width_px / std::tan(0.5 * horizontal_fov_rad);
  calibration.focal_px = {focal_px, focal_px};
  calibration.principal_point_px = {0.5 * (width_px - 1), 0.5 * (height_px - 1)};
  return calibration;
}

Eigen::Vector2d Project(const CameraCalibration& calibration, const Eigen::Vector3d& point) {
  const cv::Point2d pixel = ProjectWithLens(calibration, point).front();
  return {pixel.x, pixel.y};
}

}  // namespace deixis::geometry
