#include "common/retargeting/zero_stance.h"

#include <cmath>
#include <optional>
#include <string>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"
#include "common/config/config.h"
#include "common/retargeting/joint_paths.h"

namespace deixis::retargeting {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Axes within this angle of a file's own are the file's.
constexpr double kSnapCosine = 0.94;

std::optional<Vector3d> StartOf(const JointPaths& paths, const std::vector<DrivenLimb>& limbs,
                                const std::string& name) {
  for (const DrivenLimb& limb : limbs) {
    if (limb.limb == name) return paths.Start_m(limb);
  }
  return std::nullopt;
}

/// The starts of a pair of limbs; nothing when one is missing.
struct Pair {
  Vector3d right_m, left_m;
  Vector3d Middle() const { return 0.5 * (right_m + left_m); }
};

std::optional<Pair> FindPair(const JointPaths& paths, const std::vector<DrivenLimb>& limbs,
                             const std::string& name) {
  const auto right = StartOf(paths, limbs, "right_" + name);
  const auto left = StartOf(paths, limbs, "left_" + name);
  if (!right || !left) return std::nullopt;
  return Pair{*right, *left};
}

Vector3d Snapped(const Vector3d& direction) {
  const Vector3d unit = direction.normalized();
  Eigen::Index axis = 0;
  if (unit.cwiseAbs().maxCoeff(&axis) < kSnapCosine) return unit;
  return std::copysign(1.0, unit[axis]) * Vector3d::Unit(axis);
}

[[noreturn]] void Fail(const std::string& what) {
  throw config::ConfigError("the zero pose of the motion is no standing person: " + what);
}

Matrix3d BodyFromFile(const JointPaths& paths, const std::vector<DrivenLimb>& limbs) {
  const auto hips = FindPair(paths, limbs, "thigh");
  const auto shoulders = FindPair(paths, limbs, "upper_arm");
  auto top = StartOf(paths, limbs, "head");
  if (!top) top = StartOf(paths, limbs, "neck");
  if (!top && hips && shoulders) top = shoulders->Middle();
  if (!top) Fail("it has neither neck nor head");
  const auto pair = hips ? hips : shoulders;
  if (!pair) Fail("it has no pair of hips or shoulders");
  const Vector3d width = pair->left_m - pair->right_m;
  if (!(width.norm() > 1e-6)) Fail("its hips or shoulders lie in one place");
  const Vector3d left = Snapped(width);
  const Vector3d rise = *top - pair->Middle();
  const Vector3d across = rise - rise.dot(left) * left;
  if (!(across.norm() > 1e-6)) Fail("its head does not lie above");
  const Vector3d snapped = Snapped(across);
  const Vector3d up = (snapped - snapped.dot(left) * left).normalized();
  Matrix3d body_from_file;
  body_from_file.row(0) = left.cross(up);
  body_from_file.row(1) = left;
  body_from_file.row(2) = up;
  return body_from_file;
}

Matrix3d AlongBone(const Vector3d& bone) {
  const Vector3d z = bone.normalized();
  // An arm that is held forward has its front up.
  const Vector3d hint = std::abs(z.x()) < 0.9 ? Vector3d::UnitX() : Vector3d(0.0, 0.0, z.x());
  Matrix3d frame;
  frame.col(2) = z;
  frame.col(0) = (hint - hint.dot(z) * z).normalized();
  frame.col(1) = z.cross(frame.col(0));
  return frame;
}

}  // namespace

ZeroStance FindZeroStance(const motion::Skeleton& skeleton, const std::vector<DrivenLimb>& limbs,
                          const body_model::BodyModel& model) {
  motion::Clip still;
  still.skeleton = skeleton;
  const Matrix3d body_from_file = BodyFromFile(JointPaths(still, Matrix3d::Identity()), limbs);
  const JointPaths paths(still, body_from_file);
  body_model::Kinematics standing(model);
  standing.Update(body_model::Standing(model));
  ZeroStance stance{body_from_file, {}};
  for (const DrivenLimb& limb : limbs) {
    const auto in_model = model.Find(limb.limb);
    const bool is_bone = limb.stance == Stance::kBone && paths.HasEnd(limb);
    const Vector3d bone =
        is_bone ? Vector3d(paths.End_m(limb) - paths.Start_m(limb)) : Vector3d::Zero().eval();
    if (bone.norm() > 1e-6) {
      stance.frames.push_back(AlongBone(bone));
    } else {
      stance.frames.push_back(in_model ? standing.limb(*in_model).linear()
                                       : Matrix3d::Identity().eval());
    }
  }
  return stance;
}

}  // namespace deixis::retargeting
