#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/geometry/camera_calibration.h"

namespace deixis::geometry {

// What a lens can be. Who reads one from a file and who takes one from a message ask here, so that
// no lens is published that no receiver takes.

inline constexpr double kLeastFocal_px = 1.0;
/// Of focal lengths and principal points: far beyond any lens, yet safe to square and add up.
inline constexpr double kFarthestLens_px = 1e6;
/// Of a distortion coefficient: far beyond that of any lens.
inline constexpr double kLargestCoefficient = 1e6;
/// Of each element of R R^T, from those of the identity.
inline constexpr double kRotationTolerance = 1e-3;

// Each is false of what is not finite.
bool IsFocalLength(const Eigen::Vector2d& focal_px);
bool IsPrincipalPoint(const Eigen::Vector2d& principal_point_px);
/// As many coefficients as the model has, by lcmtypes/deixis_camera_calibration_t.lcm, none larger
/// than `kLargestCoefficient`.
bool IsDistortion(DistortionModel model, const std::vector<double>& coefficients);
bool IsRotation(const Eigen::Matrix3d& matrix);

/// All of the above; the picture's size is not looked at.
bool IsLens(const CameraCalibration& calibration);

}  // namespace deixis::geometry
