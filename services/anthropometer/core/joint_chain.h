#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/body_model/body_model.h"

namespace deixis::anthropometer {

/// A joint that turns about one axis, one of the row that stands for a limb's joint.
struct ChainJoint {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< Unit, in the frame before it turns.
  int dof = -1;           ///< The limb's dof that it equals for small angles; -1 = none.
  bool is_hinge = false;  ///< Of the model.
  double angle_min_rad = 0.0;
  double angle_max_rad = 0.0;
};

/// The limb's joint as joints about one axis each, which robots have; none = it is fixed. Two
/// swings, whose angles are components of one rotation vector, become three joints: about the axis
/// of the flexion (horizontal, if that is one), else of the first swing, +-180 degrees; about that
/// perpendicular to it and to z, +-90; and about z, with the limb's twist. The limits enclose the
/// envelope's image, no less; without a twist the third angle follows from the other two. All else
/// stays as it is, exactly.
std::vector<ChainJoint> ChainOf(const body_model::Limb& limb);

/// The chain's angles, radians, that turn the limb exactly as its own `angles_rad` do, in the order
/// of its dofs. Where the second joint stands at 90 degrees, the first one is 0.
Eigen::VectorXd ChainAngles(const body_model::Limb& limb, const Eigen::VectorXd& angles_rad);

}  // namespace deixis::anthropometer
