#include "common/body_model/kinematics.h"

#include <cmath>
#include <stdexcept>

namespace deixis::body_model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSmall2_rad2 = 1e-8;  // Below, series to the second order are exact.

Matrix3d Skew(const Vector3d& v) {
  Matrix3d skew;
  skew << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return skew;
}

}  // namespace

Matrix3d RotationFrom(const Vector3d& rotation_vector_rad) {
  const double angle2 = rotation_vector_rad.squaredNorm();
  const double angle = std::sqrt(angle2);
  const double sine = angle2 < kSmall2_rad2 ? 1.0 - angle2 / 6.0 : std::sin(angle) / angle;
  const double cosine =
      angle2 < kSmall2_rad2 ? 0.5 - angle2 / 24.0 : (1.0 - std::cos(angle)) / angle2;
  const Matrix3d skew = Skew(rotation_vector_rad);
  return Matrix3d::Identity() + sine * skew + cosine * skew * skew;
}

Matrix3d LeftJacobian(const Vector3d& rotation_vector_rad) {
  const double angle2 = rotation_vector_rad.squaredNorm();
  const double angle = std::sqrt(angle2);
  const double first =
      angle2 < kSmall2_rad2 ? 0.5 - angle2 / 24.0 : (1.0 - std::cos(angle)) / angle2;
  const double second = angle2 < kSmall2_rad2 ? 1.0 / 6.0 - angle2 / 120.0
                                              : (angle - std::sin(angle)) / (angle2 * angle);
  const Matrix3d skew = Skew(rotation_vector_rad);
  return Matrix3d::Identity() + first * skew + second * skew * skew;
}

Kinematics::Kinematics(const BodyModel& model) : model_(&model) {
  limbs_.assign(model.limbs().size(), Eigen::Isometry3d::Identity());
  axes_.setZero(3, model.angle_count());
  for (const Limb& limb : model.limbs()) {
    Eigen::Isometry3d rest = Eigen::Isometry3d::Identity();
    rest.linear() = limb.rest_in_parent.rotation.toRotationMatrix();
    rest.translation() = limb.rest_in_parent.translation_m;
    rests_.push_back(rest);
  }
}

Vector3d Kinematics::distal_m(int index) const {
  const double length_m = model_->limbs()[static_cast<std::size_t>(index)].shape.length_m;
  return proximal_m(index) + length_m * limb(index).linear().col(2);
}

void Kinematics::Update(const BodyPose& pose) {
  if (pose.angles_rad.size() != model_->angle_count()) {
    throw std::logic_error("Kinematics: " + std::to_string(pose.angles_rad.size()) +
                           " angles for a model of " + std::to_string(model_->angle_count()));
  }
  limbs_[0].linear() = pose.frame_from_root.rotation.toRotationMatrix();
  limbs_[0].translation() = pose.frame_from_root.translation_m;
  for (int i = 1; i < model_->limb_count(); ++i) UpdateLimb(i, pose.angles_rad);
}

void Kinematics::UpdateLimb(int index, const Eigen::VectorXd& angles_rad) {
  const auto i = static_cast<std::size_t>(index);
  const Limb& limb = model_->limbs()[i];
  const Eigen::Isometry3d& parent = limbs_[static_cast<std::size_t>(limb.parent)];
  limbs_[i].translation() = parent * rests_[i].translation();
  Matrix3d rotation = parent.linear() * rests_[i].linear();
  const int first = model_->first_angle(index);
  Vector3d swing = Vector3d::Zero();
  for (std::size_t k = 0; k < limb.dofs.size(); ++k) {
    const auto angle = first + static_cast<int>(k);
    if (limb.dofs[k].kind == DofKind::kSwing) swing += angles_rad[angle] * limb.dofs[k].axis;
  }
  const Matrix3d by_swing = rotation * LeftJacobian(swing);
  rotation = rotation * RotationFrom(swing);
  for (const DofKind kind : {DofKind::kHinge, DofKind::kTwist}) {
    for (std::size_t k = 0; k < limb.dofs.size(); ++k) {
      if (limb.dofs[k].kind != kind) continue;
      const auto angle = first + static_cast<int>(k);
      axes_.col(angle) = rotation * limb.dofs[k].axis;
      rotation = rotation * RotationFrom(angles_rad[angle] * limb.dofs[k].axis);
    }
  }
  for (std::size_t k = 0; k < limb.dofs.size(); ++k) {
    if (limb.dofs[k].kind != DofKind::kSwing) continue;
    axes_.col(first + static_cast<int>(k)) = by_swing * limb.dofs[k].axis;
  }
  limbs_[i].linear() = rotation;
}

void PointJacobian(const Kinematics& kinematics, int limb, const Vector3d& point_m,
                   Eigen::Ref<Eigen::Matrix3Xd> jacobian) {
  const BodyModel& model = kinematics.model();
  jacobian.setZero();
  jacobian.leftCols<3>().setIdentity();
  jacobian.middleCols<3>(3) = -Skew(point_m - kinematics.proximal_m(0));
  for (int i = limb; i > 0; i = model.limbs()[static_cast<std::size_t>(i)].parent) {
    const Vector3d arm_m = point_m - kinematics.proximal_m(i);
    const int first = model.first_angle(i);
    const auto count = static_cast<int>(model.limbs()[static_cast<std::size_t>(i)].dofs.size());
    for (int angle = first; angle < first + count; ++angle) {
      jacobian.col(6 + angle) = kinematics.angle_axis(angle).cross(arm_m);
    }
  }
}

}  // namespace deixis::body_model
