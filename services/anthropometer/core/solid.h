#pragma once
#include <Eigen/Core>

#include "common/geometry/degenerate_cylinder.h"

namespace deixis::anthropometer {

/// A limb as a homogeneous body, in its frame.
struct Solid {
  double volume_m3 = 0.0;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< Of its mass.
  /// Second moments about the centre: tensor of inertia per density, m^5.
  Eigen::Matrix3d inertia_m5 = Eigen::Matrix3d::Zero();
};

/// Exact: slices are ellipses, whose moments are polynomials of the share of the length.
Solid SolidOf(const geometry::DegenerateCylinder& shape);

/// Radius of the round cylinder of the limb's length and volume.
double MeanRadius_m(const geometry::DegenerateCylinder& shape);

}  // namespace deixis::anthropometer
