#pragma once
#include <Eigen/Core>

#include "common/body_model/body_model.h"

namespace deixis::body_model {

/// The rotation vector without twist that takes z to `direction`, a unit vector.
Eigen::Vector3d SwingTo(const Eigen::Vector3d& direction);

/// The angle about z by which `rotation` turns x, when z stays.
double TwistOf(const Eigen::Matrix3d& rotation);

/// The angles of a limb's joint, in the order of its dofs, with which its orientation in its parent
/// comes to `parent_from_limb`, a rotation matrix: exactly for a ball joint, else so that its z
/// axis points as nearly there as the joint can and, of the rest, its twist follows. Bounds do not
/// count.
Eigen::VectorXd JointAngles(const Limb& limb, const Eigen::Matrix3d& parent_from_limb);

/// The orientation of a limb in its parent with these angles of its joint, a rotation matrix.
Eigen::Matrix3d ParentFromLimb(const Limb& limb,
                               const Eigen::Ref<const Eigen::VectorXd>& angles_rad);

/// Turns a limb so that it points along `direction`, in the frame of the pose's root, of any
/// length; its twist becomes 0. Angles of other limbs stay.
void PointLimb(const BodyModel& model, int limb, const Eigen::Vector3d& direction, BodyPose& pose);

/// Turns a limb as nearly as its joint can to an orientation in the frame of the pose's root, a
/// rotation matrix. Angles of other limbs stay.
void OrientLimb(const BodyModel& model, int limb, const Eigen::Matrix3d& root_from_limb,
                BodyPose& pose);

/// Brings every angle that is outside the envelope of its joint to the nearer bound.
void ClampToEnvelope(const BodyModel& model, BodyPose& pose);

/// The neutral-zero stance: upright, arms and legs hanging, their fronts forward.
BodyPose Standing(const BodyModel& model);

}  // namespace deixis::body_model
