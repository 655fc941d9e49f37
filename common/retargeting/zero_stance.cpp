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
constexpr double kShortest_m = 1e-6;

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
  if (!(width.norm() > kShortest_m)) Fail("its hips or shoulders lie in one place");
  const Vector3d left = Snapped(width);
  const Vector3d rise = *top - pair->Middle();
  const Vector3d across = rise - rise.dot(left) * left;
  if (!(across.norm() > kShortest_m)) Fail("its head does not lie above");
  const Vector3d snapped = Snapped(across);
  const Vector3d up = (snapped - snapped.dot(left) * left).normalized();
  Matrix3d body_from_file;
  body_from_file.row(0) = left.cross(up);
  body_from_file.row(1) = left;
  body_from_file.row(2) = up;
  return body_from_file;
}

/// Of a limb that stands along its bone; zero of others.
Vector3d BoneOf(const JointPaths& paths, const DrivenLimb& limb) {
  if (limb.stance != Stance::kBone || !paths.HasEnd(limb)) return Vector3d::Zero();
  return paths.End_m(limb) - paths.Start_m(limb);
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
  ZeroStance stance{body_from_file, std::vector<Matrix3d>(limbs.size(), Matrix3d::Identity())};
  std::vector<Matrix3d> in_file(model.limbs().size());
  for (int i = 0; i < model.limb_count(); ++i) {
    Matrix3d& frame = in_file[static_cast<std::size_t>(i)];
    const body_model::Limb& limb = model.limbs()[static_cast<std::size_t>(i)];
    // Feet of spread legs stand on their shanks, not on the floor.
    frame = standing.limb(i).linear();
    if (limb.parent >= 0) {
      frame = in_file[static_cast<std::size_t>(limb.parent)] *
              standing.limb(limb.parent).linear().transpose() * frame;
    }
    for (std::size_t k = 0; k < limbs.size(); ++k) {
      if (limbs[k].limb != limb.name) continue;
      const Vector3d bone = BoneOf(paths, limbs[k]);
      if (bone.norm() > kShortest_m) frame = AlongBone(bone);
      stance.frames[k] = frame;
    }
  }
  return stance;
}

}  // namespace deixis::retargeting
