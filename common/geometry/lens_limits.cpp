#include "common/geometry/lens_limits.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace deixis::geometry {
namespace {

// OpenCV takes the shorter forms, too.
bool HasAllCoefficients(DistortionModel model, std::size_t n) {
  switch (model) {
    case DistortionModel::kNone:
      return n == 0;
    case DistortionModel::kPlumbBob:
      return n == 4 || n == 5;
    case DistortionModel::kRational:
      return n == 8 || n == 12 || n == 14;
    case DistortionModel::kFisheye:
      return n == 4;
  }
  return false;
}

}  // namespace

bool IsFocalLength(const Eigen::Vector2d& focal_px) {
  return (focal_px.array() >= kLeastFocal_px).all() && (focal_px.array() <= kFarthestLens_px).all();
}

bool IsPrincipalPoint(const Eigen::Vector2d& principal_point_px) {
  return (principal_point_px.array().abs() <= kFarthestLens_px).all();
}

bool IsDistortion(DistortionModel model, const std::vector<double>& coefficients) {
  return HasAllCoefficients(model, coefficients.size()) &&
         std::all_of(coefficients.begin(), coefficients.end(),
                     [](double value) { return std::abs(value) <= kLargestCoefficient; });
}

bool IsRotation(const Eigen::Matrix3d& matrix) {
  return (matrix * matrix.transpose()).isIdentity(kRotationTolerance) && matrix.determinant() > 0.0;
}

bool IsLens(const CameraCalibration& calibration) {
  return IsFocalLength(calibration.focal_px) && IsPrincipalPoint(calibration.principal_point_px) &&
         IsDistortion(calibration.distortion_model, calibration.distortion) &&
         IsRotation(calibration.rectification);
}

}  // namespace deixis::geometry
