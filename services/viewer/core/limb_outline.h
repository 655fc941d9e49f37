#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/geometry/camera_calibration.h"
#include "common/geometry/degenerate_cylinder.h"
#include "common/geometry/rigid_transform.h"

namespace deixis::viewer {

/// What a limb covers in the picture of a camera without distortion, pixels, as a convex polygon;
/// empty when all of it lies behind the camera, or nearer to it than 0.1 m.
std::vector<Eigen::Vector2d> OutlineOf(const geometry::DegenerateCylinder& limb,
                                       const geometry::RigidTransform& camera_from_limb,
                                       const geometry::CameraCalibration& camera);

/// Where 9 of 10 points of a normal distribution are seen, pixels, as a polygon: mean (metres, in
/// the camera's frame) and covariance (square metres) projected to first order. Empty when the mean
/// lies nearer than 0.1 m, or the covariance is zero: not known.
std::vector<Eigen::Vector2d> SpreadOf(const Eigen::Vector3d& mean_m,
                                      const Eigen::Matrix3d& covariance_m2,
                                      const geometry::CameraCalibration& camera);

}  // namespace deixis::viewer
