#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "common/geometry/stereo_calibration.h"

namespace deixis::pose_fitter {

/// How far a depth may be off, one sigma: sqrt(floor^2 + (per_square_m z^2)^2).
struct DepthNoise {
  double floor_m = 0.003;
  double per_square_m = 0.003;  ///< Of a stereo rig: disparity sigma / (focal length * baseline).

  double Sigma_m(double z_m) const;
};

/// The pinhole that a depth image is seen through, at the size of that image.
struct DepthCamera {
  int width_px = 0;
  int height_px = 0;
  Eigen::Vector2d focal_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  DepthNoise noise;

  /// Of the point in the camera's optical frame, z > 0; pixels.
  Eigen::Vector2d Project(const Eigen::Vector3d& point_m) const;
  /// The point at distance 1 along the optical axis that this pixel sees.
  Eigen::Vector3d Ray(double u_px, double v_px) const;
  bool Contains(const Eigen::Vector2d& pixel_px) const;  ///< Its nearest pixel is in the image.
};

/// The camera of depth images of this size that cover the view of the calibration's published
/// picture. Throws std::logic_error on a size that is none.
DepthCamera DepthCameraOf(const geometry::StereoCalibration& calibration, cv::Size depth_px);

/// One depth image in metres. Takes its memory once per size.
class DepthView {
 public:
  /// `depth_mm`: CV_16UC1, 0 = not measured, of the camera's size (else std::logic_error).
  void Update(const DepthCamera& camera, const cv::Mat& depth_mm);

  const DepthCamera& camera() const { return camera_; }
  int width_px() const { return camera_.width_px; }
  int height_px() const { return camera_.height_px; }
  /// Row by row, along the optical axis; 0 = not measured.
  const std::vector<float>& z_m() const { return z_m_; }
  float z_m(int u_px, int v_px) const {
    return z_m_[static_cast<std::size_t>(v_px) * static_cast<std::size_t>(camera_.width_px) +
                static_cast<std::size_t>(u_px)];
  }
  const float* row_m(int v_px) const { return &z_m_[static_cast<std::size_t>(v_px * width_px())]; }
  Eigen::Vector3d Point(int u_px, int v_px) const;  ///< In the camera's optical frame.

 private:
  DepthCamera camera_;
  std::vector<float> z_m_;
};

}  // namespace deixis::pose_fitter
