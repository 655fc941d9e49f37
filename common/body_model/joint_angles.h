#pragma once
#include <Eigen/Core>

#include "common/body_model/body_model.h"

namespace deixis::body_model {

/// The angles of a limb's joint, in the order of its dofs, with which its orientation in its parent
/// comes to `parent_from_limb`, a rotation matrix: exactly for a ball joint, else so that its z
/// axis points as nearly there as the joint can and, of the rest, its twist follows. Bounds do not
/// count.
Eigen::VectorXd JointAngles(const Limb& limb, const Eigen::Matrix3d& parent_from_limb);

/// Turns a limb so that it points along `direction`, in the frame of the pose's root, of any
/// length; its twist becomes 0. Angles of other limbs stay.
void PointLimb(const BodyModel& model, int limb, const Eigen::Vector3d& direction, BodyPose& pose);

/// Upright: all angles at rest, but upper arms and thighs hang, where the model has them.
BodyPose Standing(const BodyModel& model);

}  // namespace deixis::body_model
