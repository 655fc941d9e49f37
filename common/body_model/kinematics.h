#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "common/body_model/body_model.h"

namespace deixis::body_model {

/// exp of a rotation vector, radians: Rodrigues' formula, exact at 0 too.
Eigen::Matrix3d RotationFrom(const Eigen::Vector3d& rotation_vector_rad);

/// Left Jacobian of SO(3): exp(v + dv) = exp(J dv) exp(v) to first order. Regular up to 360
/// degrees.
Eigen::Matrix3d LeftJacobian(const Eigen::Vector3d& rotation_vector_rad);

/// Where each limb is in one pose, and how it turns with each angle. Takes its memory once.
class Kinematics {
 public:
  explicit Kinematics(const BodyModel& model);  ///< `model` must outlive it.

  /// Forward kinematics. Throws std::logic_error when the number of angles is not the model's.
  void Update(const BodyPose& pose);

  const BodyModel& model() const { return *model_; }
  /// frame_from_limb, the frame being that of the pose's root.
  const Eigen::Isometry3d& limb(int index) const { return limbs_[static_cast<std::size_t>(index)]; }
  /// The limb's proximal joint.
  Eigen::Vector3d proximal_m(int index) const { return limb(index).translation(); }
  /// The limb's distal end on its bone line.
  Eigen::Vector3d distal_m(int index) const;
  /// Angular velocity of its limb and of all limbs beyond it, in the frame, per rate of the angle.
  /// They turn about the limb's proximal joint.
  Eigen::Vector3d angle_axis(int angle) const { return axes_.col(angle); }

 private:
  void UpdateLimb(int index, const Eigen::VectorXd& angles_rad);

  const BodyModel* model_;
  std::vector<Eigen::Isometry3d> limbs_;
  std::vector<Eigen::Isometry3d> rests_;  ///< parent_from_limb at zero angles.
  Eigen::Matrix3Xd axes_;
};

/// Derivative of a point that is fixed to a limb, both in the frame, by root translation (3,
/// metres), root rotation (3, a rotation vector in the frame, radians) and angles (radians), in
/// that order: 3 x (6 + angles). Only ancestors of the limb and itself have columns that are not
/// zero.
void PointJacobian(const Kinematics& kinematics, int limb, const Eigen::Vector3d& point_m,
                   Eigen::Ref<Eigen::Matrix3Xd> jacobian);

}  // namespace deixis::body_model
