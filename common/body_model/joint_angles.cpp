#include "common/body_model/joint_angles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/body_model/kinematics.h"

namespace deixis::body_model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// The angle about `axis` that takes z nearest to `direction`.
double HingeTo(const Vector3d& axis, const Vector3d& direction) {
  const Vector3d z = Vector3d::UnitZ() - axis.z() * axis;
  const Vector3d there = direction - axis.dot(direction) * axis;
  return std::atan2(z.cross(there).dot(axis), z.dot(there));
}

bool IsAlongZ(const Vector3d& axis) { return std::abs(axis.z()) > 1.0 - 1e-9; }

Matrix3d RootFromParent(const BodyModel& model, int parent, const BodyPose& pose) {
  Kinematics kinematics(model);
  BodyPose upright = pose;
  upright.frame_from_root = {};
  kinematics.Update(upright);
  return kinematics.limb(parent).linear();
}

}  // namespace

Vector3d SwingTo(const Vector3d& direction) {
  const Vector3d across(-direction.y(), direction.x(), 0.0);  // z x direction
  const double sine = across.norm();
  const double angle = std::atan2(sine, direction.z());
  if (sine > 1e-12) return across * (angle / sine);
  return direction.z() > 0.0 ? Vector3d::Zero().eval() : Vector3d(M_PI, 0.0, 0.0);
}

double TwistOf(const Matrix3d& rotation) {
  return std::atan2(rotation(1, 0) - rotation(0, 1), rotation(0, 0) + rotation(1, 1));
}

VectorXd JointAngles(const Limb& limb, const Matrix3d& parent_from_limb) {
  VectorXd angles = VectorXd::Zero(static_cast<Eigen::Index>(limb.dofs.size()));
  Matrix3d left = limb.rest_in_parent.rotation.toRotationMatrix().transpose() * parent_from_limb;
  const Vector3d swing = SwingTo(left.col(2));
  Vector3d taken = Vector3d::Zero();
  for (std::size_t k = 0; k < limb.dofs.size(); ++k) {
    if (limb.dofs[k].kind != DofKind::kSwing) continue;
    angles[static_cast<Eigen::Index>(k)] = swing.dot(limb.dofs[k].axis);
    taken += swing.dot(limb.dofs[k].axis) * limb.dofs[k].axis;
  }
  left = RotationFrom(taken).transpose() * left;
  for (const DofKind kind : {DofKind::kHinge, DofKind::kTwist}) {
    for (std::size_t k = 0; k < limb.dofs.size(); ++k) {
      if (limb.dofs[k].kind != kind) continue;
      const Vector3d& axis = limb.dofs[k].axis;
      const double angle = IsAlongZ(axis) ? axis.z() * TwistOf(left) : HingeTo(axis, left.col(2));
      angles[static_cast<Eigen::Index>(k)] = angle;
      left = RotationFrom(angle * axis).transpose() * left;
    }
  }
  return angles;
}

Matrix3d ParentFromLimb(const Limb& limb, const Eigen::Ref<const VectorXd>& angles_rad) {
  Vector3d swing = Vector3d::Zero();
  Matrix3d turns = Matrix3d::Identity();
  for (const DofKind kind : {DofKind::kSwing, DofKind::kHinge, DofKind::kTwist}) {
    for (std::size_t k = 0; k < limb.dofs.size(); ++k) {
      if (limb.dofs[k].kind != kind) continue;
      const Vector3d turn = angles_rad[static_cast<Eigen::Index>(k)] * limb.dofs[k].axis;
      if (kind == DofKind::kSwing) {
        swing += turn;
      } else {
        turns = turns * RotationFrom(turn);
      }
    }
  }
  return limb.rest_in_parent.rotation.toRotationMatrix() * RotationFrom(swing) * turns;
}

void PointLimb(const BodyModel& model, int limb, const Vector3d& direction, BodyPose& pose) {
  const Limb& moved = model.limbs()[static_cast<std::size_t>(limb)];
  const Matrix3d root_from_rest =
      RootFromParent(model, moved.parent, pose) * moved.rest_in_parent.rotation.toRotationMatrix();
  const Vector3d there = root_from_rest.transpose() * direction.normalized();
  OrientLimb(model, limb, root_from_rest * RotationFrom(SwingTo(there)), pose);
}

void OrientLimb(const BodyModel& model, int limb, const Matrix3d& root_from_limb, BodyPose& pose) {
  const Limb& moved = model.limbs()[static_cast<std::size_t>(limb)];
  pose.angles_rad.segment(model.first_angle(limb), static_cast<Eigen::Index>(moved.dofs.size())) =
      JointAngles(moved, RootFromParent(model, moved.parent, pose).transpose() * root_from_limb);
}

void ClampToEnvelope(const BodyModel& model, BodyPose& pose) {
  int angle = 0;
  for (const Limb& limb : model.limbs()) {
    for (const DegreeOfFreedom& dof : limb.dofs) {
      pose.angles_rad[angle] =
          std::clamp(pose.angles_rad[angle], dof.angle_min_rad, dof.angle_max_rad);
      ++angle;
    }
  }
}

BodyPose Standing(const BodyModel& model) {
  Matrix3d hanging;  // z down, x forward.
  hanging << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  BodyPose pose = RestPose(model);
  for (const char* limb : {"right_upper_arm", "left_upper_arm", "right_thigh", "left_thigh"}) {
    if (const auto index = model.Find(limb)) OrientLimb(model, *index, hanging, pose);
  }
  return pose;
}

}  // namespace deixis::body_model
