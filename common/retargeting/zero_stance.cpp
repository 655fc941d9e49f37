#include "common/retargeting/zero_stance.h"

#include <cmath>
#include <initializer_list>
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
/// Cosines: legs are spread by less than 60 degrees, no foot points backwards by more than 10.
constexpr double kHanging = 0.5, kBackward = 0.17;

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

/// Where the trunk begins and ends.
struct Trunk {
  Vector3d bottom_m, top_m;
};

std::optional<Vector3d> FirstOf(const JointPaths& paths, const std::vector<DrivenLimb>& limbs,
                                std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (const auto start = StartOf(paths, limbs, name)) return start;
  }
  return std::nullopt;
}

Trunk FindTrunk(const JointPaths& paths, const std::vector<DrivenLimb>& limbs,
                const std::optional<Pair>& hips, const std::optional<Pair>& shoulders) {
  const auto bottom =
      hips ? std::optional(hips->Middle()) : FirstOf(paths, limbs, {"pelvis", "torso"});
  const auto head = FirstOf(paths, limbs, {"head", "neck"});
  const auto between = shoulders ? std::optional(shoulders->Middle()) : std::optional<Vector3d>();
  // A head may begin below the shoulders, but not below the hips.
  const auto top = hips ? (head ? head : between) : (between ? between : head);
  if (!bottom) Fail("it has neither hips nor a base of the trunk");
  if (!top) Fail("it has neither shoulders nor neck nor head");
  return {*bottom, *top};
}

/// To the person's left: along the hips, else the shoulders, else away from the only shoulder.
Vector3d FindLeft(const JointPaths& paths, const std::vector<DrivenLimb>& limbs,
                  const std::optional<Pair>& pair, const Trunk& trunk) {
  if (pair) return pair->left_m - pair->right_m;
  const Vector3d along = (trunk.top_m - trunk.bottom_m).normalized();
  for (const double side : {1.0, -1.0}) {
    const auto arm = StartOf(paths, limbs, side > 0.0 ? "right_upper_arm" : "left_upper_arm");
    if (!arm) continue;
    const Vector3d outward = *arm - trunk.bottom_m;
    return -side * (outward - outward.dot(along) * along);
  }
  Fail("it has neither hips nor shoulders");
}

Matrix3d BodyFromFile(const JointPaths& paths, const std::vector<DrivenLimb>& limbs) {
  const auto hips = FindPair(paths, limbs, "thigh");
  const auto shoulders = FindPair(paths, limbs, "upper_arm");
  const Trunk trunk = FindTrunk(paths, limbs, hips, shoulders);
  const Vector3d width = FindLeft(paths, limbs, hips ? hips : shoulders, trunk);
  if (!(width.norm() > kShortest_m)) Fail("its hips or shoulders lie in one place");
  const Vector3d left = Snapped(width);
  const Vector3d rise = trunk.top_m - trunk.bottom_m;
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

/// Throws when it is nobody's who stands: legs that do not hang, feet that point backwards.
void RequireStanding(const JointPaths& paths, const std::vector<DrivenLimb>& limbs) {
  for (const DrivenLimb& limb : limbs) {
    if (!paths.HasEnd(limb)) continue;
    const Vector3d bone = (paths.End_m(limb) - paths.Start_m(limb)).normalized();
    const auto is = [&limb](const char* name) {
      return limb.limb.size() > std::string(name).size() &&
             limb.limb.compare(limb.limb.size() - std::string(name).size(), std::string::npos,
                               name) == 0;
    };
    if ((is("_thigh") || is("_shank")) && !(bone.z() < -kHanging)) {
      Fail(limb.limb + " does not hang down");
    }
    if (is("_foot") && bone.x() < -kBackward) {
      Fail(limb.limb + " points backwards; are left and right exchanged?");
    }
  }
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
  RequireStanding(paths, limbs);
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
