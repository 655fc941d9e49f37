#include "services/pose_fitter/core/depth/depth_view.h"

#include <cmath>
#include <stdexcept>

namespace deixis::pose_fitter {

double DepthNoise::Sigma_m(double z_m) const {
  const double grown_m = per_square_m * z_m * z_m;
  return std::sqrt(floor_m * floor_m + grown_m * grown_m);  // std::hypot takes ten times as long.
}

Eigen::Vector2d DepthCamera::Project(const Eigen::Vector3d& point_m) const {
  return focal_px.cwiseProduct(point_m.head<2>() / point_m.z()) + centre_px;
}

Eigen::Vector3d DepthCamera::Ray(double u_px, double v_px) const {
  return {(u_px - centre_px.x()) / focal_px.x(), (v_px - centre_px.y()) / focal_px.y(), 1.0};
}

bool DepthCamera::Contains(const Eigen::Vector2d& pixel_px) const {
  return pixel_px.x() >= -0.5 && pixel_px.y() >= -0.5 && pixel_px.x() < width_px - 0.5 &&
         pixel_px.y() < height_px - 0.5;
}

DepthCamera DepthCameraOf(const geometry::StereoCalibration& calibration, cv::Size depth_px) {
  if (depth_px.width <= 0 || depth_px.height <= 0) {
    throw std::logic_error("depth camera: the depth image has no pixels");
  }
  const auto scaled = Scaled(calibration.rectified, depth_px.width, depth_px.height);
  DepthCamera camera{
      depth_px.width, depth_px.height, scaled.focal_px, scaled.principal_point_px, {}};
  if (calibration.disparity_sigma_px > 0.0) {
    const double baseline_m = calibration.right_from_left.translation_m.norm();
    camera.noise.per_square_m = calibration.disparity_sigma_px /
                                (calibration.rectified.focal_px.x() * std::max(baseline_m, 1e-3));
  } else if (calibration.depth_sigma_m_at_1m > 0.0) {
    camera.noise.per_square_m = calibration.depth_sigma_m_at_1m;
  }
  return camera;
}

void DepthView::Update(const DepthCamera& camera, const cv::Mat& depth_mm) {
  if (depth_mm.type() != CV_16UC1 || depth_mm.cols != camera.width_px ||
      depth_mm.rows != camera.height_px) {
    throw std::logic_error("depth view: the image does not suit its camera");
  }
  camera_ = camera;
  z_m_.resize(depth_mm.total());
  auto out = z_m_.begin();
  for (int v = 0; v < depth_mm.rows; ++v) {
    const auto* row = depth_mm.ptr<std::uint16_t>(v);
    for (int u = 0; u < depth_mm.cols; ++u) *out++ = 0.001F * static_cast<float>(row[u]);
  }
}

Eigen::Vector3d DepthView::Point(int u_px, int v_px) const {
  return camera_.Ray(u_px, v_px) * static_cast<double>(z_m(u_px, v_px));
}

}  // namespace deixis::pose_fitter
