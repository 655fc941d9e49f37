#include "services/anthropometer/core/joint_chain.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "common/body_model/kinematics.h"

namespace deixis::anthropometer {
namespace {

using body_model::DegreeOfFreedom;
using body_model::DofKind;
using body_model::Limb;
using body_model::RotationFrom;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kSteps = 128;  // Of each swing, between its bounds.
// More than any angle is beyond those at the nearest steps, which are 3 degrees apart at most.
constexpr double kMargin_rad = 0.027;

/// How a limb with two swings turns: first * second * third.
struct SwingAxes {
  int first = -1, second = -1, twist = -1;  // Dofs; without a twist -1.
  Vector3d first_axis, second_axis, third_axis;
};

/// Goes first whatever its bounds are, so that a joint's meaning does not change with them.
bool IsFlexion(const DegreeOfFreedom& dof) {
  return dof.name == "flexion" || dof.name == "horizontal_flexion";
}

std::optional<SwingAxes> SwingAxesOf(const Limb& limb) {
  SwingAxes axes;
  for (int k = 0; k < static_cast<int>(limb.dofs.size()); ++k) {
    const DofKind kind = limb.dofs[static_cast<std::size_t>(k)].kind;
    if (kind == DofKind::kTwist) axes.twist = k;
    if (kind == DofKind::kSwing) (axes.first < 0 ? axes.first : axes.second) = k;
  }
  if (axes.second < 0) return std::nullopt;
  const auto dof = [&](int k) { return limb.dofs[static_cast<std::size_t>(k)]; };
  if (IsFlexion(dof(axes.second))) std::swap(axes.first, axes.second);
  axes.first_axis = dof(axes.first).axis;
  axes.second_axis = Vector3d::UnitZ().cross(axes.first_axis);
  if (axes.second_axis.dot(dof(axes.second).axis) < 0.0) axes.second_axis *= -1.0;
  axes.third_axis = axes.twist < 0 ? Vector3d::UnitZ().eval() : dof(axes.twist).axis;
  return axes;
}

Matrix3d TurnOf(const Limb& limb, const VectorXd& angles_rad) {
  Vector3d swing = Vector3d::Zero(), twist = Vector3d::Zero();
  for (std::size_t k = 0; k < limb.dofs.size(); ++k) {
    const Vector3d turn = angles_rad[static_cast<Eigen::Index>(k)] * limb.dofs[k].axis;
    (limb.dofs[k].kind == DofKind::kTwist ? twist : swing) += turn;
  }
  return RotationFrom(swing) * RotationFrom(twist);
}

/// The three angles about the axes that make up `turn`.
Vector3d AnglesAbout(const SwingAxes& axes, const Matrix3d& turn) {
  const Vector3d along = turn.col(2);
  const Vector3d across = Vector3d::UnitZ().cross(axes.first_axis);
  const double second_sign = across.dot(axes.second_axis);  // 1 or -1
  const double beside = std::hypot(along.z(), along.dot(across));
  // Where the limb lies along the first axis, the first and the third joint turn alike.
  const double first = beside < 1e-9 ? 0.0 : std::atan2(-along.dot(across), along.z());
  const double second = std::atan2(second_sign * along.dot(axes.first_axis), beside);
  const Matrix3d left = RotationFrom(second * axes.second_axis).transpose() *
                        RotationFrom(first * axes.first_axis).transpose() * turn;
  const double third = std::atan2(left(1, 0) - left(0, 1), left(0, 0) + left(1, 1));
  return {first, second, axes.third_axis.z() * third};
}

double At(const DegreeOfFreedom& dof, int step) {
  return dof.angle_min_rad + (dof.angle_max_rad - dof.angle_min_rad) * step / kSteps;
}

std::vector<ChainJoint> ChainOfSwings(const Limb& limb, const SwingAxes& axes) {
  Vector3d low = Vector3d::Constant(1e9), high = -low;
  VectorXd angles = VectorXd::Zero(static_cast<Eigen::Index>(limb.dofs.size()));
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; k <= kSteps; ++k) {
      angles[axes.first] = At(limb.dofs[static_cast<std::size_t>(axes.first)], i);
      angles[axes.second] = At(limb.dofs[static_cast<std::size_t>(axes.second)], k);
      const Vector3d there = AnglesAbout(axes, TurnOf(limb, angles));
      low = low.cwiseMin(there);
      high = high.cwiseMax(there);
    }
  }
  if (axes.twist >= 0) {
    low.z() += limb.dofs[static_cast<std::size_t>(axes.twist)].angle_min_rad;
    high.z() += limb.dofs[static_cast<std::size_t>(axes.twist)].angle_max_rad;
  }
  low.array() -= kMargin_rad;
  high.array() += kMargin_rad;
  low[1] = std::max(low[1], -M_PI_2);
  high[1] = std::min(high[1], M_PI_2);
  // Angles are told within +-180 degrees: what goes beyond comes back from the other side.
  for (int i = 0; i < 3; ++i) {
    if (low[i] < -M_PI || high[i] > M_PI) std::tie(low[i], high[i]) = std::pair(-M_PI, M_PI);
  }
  return {{axes.first_axis, axes.first, false, low[0], high[0]},
          {axes.second_axis, axes.second, false, low[1], high[1]},
          {axes.third_axis, axes.twist, false, low[2], high[2]}};
}

}  // namespace

std::vector<ChainJoint> ChainOf(const Limb& limb) {
  if (const auto axes = SwingAxesOf(limb)) return ChainOfSwings(limb, *axes);
  std::vector<ChainJoint> chain;
  // As the limb turns: a swing, then hinges, then the twist.
  for (const DofKind kind : {DofKind::kSwing, DofKind::kHinge, DofKind::kTwist}) {
    for (std::size_t k = 0; k < limb.dofs.size(); ++k) {
      const DegreeOfFreedom& dof = limb.dofs[k];
      if (dof.kind != kind) continue;
      chain.push_back({dof.axis, static_cast<int>(k), kind == DofKind::kHinge, dof.angle_min_rad,
                       dof.angle_max_rad});
    }
  }
  return chain;
}

VectorXd ChainAngles(const Limb& limb, const VectorXd& angles_rad) {
  if (const auto axes = SwingAxesOf(limb)) return AnglesAbout(*axes, TurnOf(limb, angles_rad));
  const auto chain = ChainOf(limb);
  VectorXd angles(static_cast<Eigen::Index>(chain.size()));
  for (std::size_t i = 0; i < chain.size(); ++i) {
    angles[static_cast<Eigen::Index>(i)] = angles_rad[chain[i].dof];
  }
  return angles;
}

}  // namespace deixis::anthropometer
