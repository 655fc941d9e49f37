#include "common/geometry/camera_calibration.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/geometry/lens_limits.h"

namespace deixis::geometry {

CameraCalibration GuessCalibration(int width_px, int height_px, double horizontal_fov_rad) {
  if (width_px <= 0 || height_px <= 0) throw std::invalid_argument("image size must be positive");
  if (!(horizontal_fov_rad > 0.0 && horizontal_fov_rad < M_PI)) {
    throw std::invalid_argument("horizontal field of view must lie between 0 and pi rad");
  }
  CameraCalibration calibration;
  calibration.width_px = width_px;
  calibration.height_px = height_px;
  const double focal_px = std::clamp(0.5 * width_px / std::tan(0.5 * horizontal_fov_rad),
                                     kLeastFocal_px, kFarthestLens_px);
  calibration.focal_px = {focal_px, focal_px};
  calibration.principal_point_px = {0.5 * (width_px - 1), 0.5 * (height_px - 1)};
  return calibration;
}

// The origin is the centre of the top-left pixel, so a scaled picture's centres shift by half a
// pixel.
CameraCalibration Scaled(CameraCalibration calibration, int width_px, int height_px) {
  const Eigen::Array2d scale(static_cast<double>(width_px) / calibration.width_px,
                             static_cast<double>(height_px) / calibration.height_px);
  calibration.focal_px.array() *= scale;
  calibration.principal_point_px =
      ((calibration.principal_point_px.array() + 0.5) * scale - 0.5).matrix();
  calibration.width_px = width_px;
  calibration.height_px = height_px;
  return calibration;
}

}  // namespace deixis::geometry
