#include "common/retargeting/retarget.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"
#include "common/config/config.h"
#include "common/retargeting/joint_paths.h"
#include "common/retargeting/zero_stance.h"

namespace deixis::retargeting {
namespace {

using body_model::BodyModel;
using body_model::BodyPose;
using body_model::DofKind;
using body_model::Kinematics;
using body_model::Limb;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kBentEnough_rad = 15.0 * M_PI / 180.0;
constexpr double kShortest_m = 0.01;
/// Times the average person: people of 0.85 m to 2.5 m.
constexpr double kSmallest = 0.5, kLargest = 1.5;

const Limb& LimbAt(const BodyModel& model, int limb) {
  return model.limbs()[static_cast<std::size_t>(limb)];
}

/// Which driven limb stands for each limb of the model, -1 = none.
class Drivers {
 public:
  Drivers(const BodyModel& model, const std::vector<DrivenLimb>& limbs) : limbs_(&limbs) {
    for (const Limb& limb : model.limbs()) {
      const auto at = std::find_if(limbs.begin(), limbs.end(), [&limb](const DrivenLimb& driven) {
        return driven.limb == limb.name;
      });
      of_limb_.push_back(at == limbs.end() ? -1 : static_cast<int>(at - limbs.begin()));
    }
  }
  int Index(int limb) const { return limb < 0 ? -1 : of_limb_[static_cast<std::size_t>(limb)]; }
  const DrivenLimb* Find(int limb) const {
    const int index = Index(limb);
    return index < 0 ? nullptr : &(*limbs_)[static_cast<std::size_t>(index)];
  }

 private:
  const std::vector<DrivenLimb>* limbs_;
  std::vector<int> of_limb_;
};

/// A limb that starts where another one would, which the model lacks, is given that one's joint.
std::vector<DrivenLimb> SuitedTo(const BodyModel& model, std::vector<DrivenLimb> limbs) {
  const std::vector<DrivenLimb> all = limbs;
  for (DrivenLimb& limb : limbs) {
    if (limb.after.empty() || model.Find(limb.after)) continue;
    for (const DrivenLimb& other : all) {
      if (other.limb == limb.after) limb.starts_at = other.starts_at;
    }
  }
  return limbs;
}

bool StartsWith(const Limb& limb, DofKind kind) {
  return !limb.dofs.empty() && limb.dofs.front().kind == kind;
}

Matrix3d Twisted(const Matrix3d& frame, double angle_rad) {
  return frame * body_model::RotationFrom(angle_rad * Vector3d::UnitZ());
}

/// `frame` about its z so that x lies as `x` does.
Matrix3d WithFront(const Matrix3d& frame, const Vector3d& x) {
  const Vector3d local = frame.transpose() * x;
  return Twisted(frame, std::atan2(local.y(), local.x()));
}

/// The limbs of a clip over its frames.
class LimbPaths {
 public:
  LimbPaths(const motion::Clip& clip, const SkeletonMap& map, const BodyModel& model)
      : frame_count_(clip.frames.rows()),
        limbs_(SuitedTo(model, Bind(map, clip.skeleton))),
        stance_(FindZeroStance(clip.skeleton, limbs_, model)),
        paths_(clip, stance_.body_from_file),
        drivers_(model, limbs_) {
    if (drivers_.Index(0) < 0) {
      throw config::ConfigError(
          "config/skeletons/" + map.name +
          ".yaml does not say which joint of this motion turns the base limb '" +
          model.limbs().front().name + "'");
    }
    for (int limb = 1; limb < model.limb_count(); ++limb) AlignHinge(model, limb);
  }

  Eigen::Index frame_count() const { return frame_count_; }
  void Seek(Eigen::Index frame) { paths_.Seek(frame); }
  void SeekZero() { paths_.SeekZero(); }

  /// By limb of the model.
  bool IsDriven(int limb) const { return drivers_.Index(limb) >= 0; }
  Vector3d Start_m(int limb) const { return paths_.Start_m(*drivers_.Find(limb)); }
  std::optional<Vector3d> End_m(int limb) const {
    const DrivenLimb& driven = *drivers_.Find(limb);
    if (!paths_.HasEnd(driven)) return std::nullopt;
    return paths_.End_m(driven);
  }
  /// Whether its length and its end are those of the file's bone.
  bool IsBone(int limb) const {
    const DrivenLimb& driven = *drivers_.Find(limb);
    return (driven.stance == Stance::kBone || driven.is_aimed) && paths_.HasEnd(driven);
  }
  Matrix3d Orientation(int limb) const {
    const DrivenLimb& driven = *drivers_.Find(limb);
    const Matrix3d turned = paths_.Turn(driven) * FrameOf(limb);
    if (!driven.is_aimed || !paths_.HasEnd(driven)) return turned;
    const Vector3d start_m =
        limb == 0 ? MiddleOfHips().value_or(paths_.Start_m(driven)) : paths_.Start_m(driven);
    const Vector3d aim = paths_.End_m(driven) - start_m;
    if (aim.norm() < kShortest_m) return turned;
    return Eigen::Quaterniond::FromTwoVectors(turned.col(2), aim).toRotationMatrix() * turned;
  }
  std::optional<Vector3d> MiddleOfHips() const {
    std::optional<Vector3d> right, left;
    for (const DrivenLimb& limb : limbs_) {
      if (limb.limb == "right_thigh") right = paths_.Start_m(limb);
      if (limb.limb == "left_thigh") left = paths_.Start_m(limb);
    }
    if (!right || !left) return std::nullopt;
    return Vector3d(0.5 * (*right + *left));
  }

 private:
  const Matrix3d& FrameOf(int limb) const {
    return stance_.frames[static_cast<std::size_t>(drivers_.Index(limb))];
  }
  Matrix3d& FrameOf(int limb) {
    return stance_.frames[static_cast<std::size_t>(drivers_.Index(limb))];
  }

  /// The mean axis about which the bone of `limb` bends against its parent's, in the zero pose's
  /// body axes, in the sense of `expected`; zero when it hardly does.
  Vector3d BendAxis(int parent, int limb, const Vector3d& expected) {
    const Vector3d along = FrameOf(parent).col(2);
    Vector3d sum = Vector3d::Zero();
    for (Eigen::Index frame = 0; frame < frame_count_; ++frame) {
      Seek(frame);
      const auto end_m = End_m(limb);
      if (!end_m) break;
      const Vector3d bone =
          paths_.Turn(*drivers_.Find(parent)).transpose() * (*end_m - Start_m(limb)).normalized();
      const Vector3d axis = along.cross(bone);
      const bool is_bent = axis.norm() > std::sin(kBentEnough_rad) || along.dot(bone) < 0.0;
      if (is_bent && axis.dot(expected) > 0.0) sum += axis;
    }
    return sum;
  }

  void AlignHinge(const BodyModel& model, int limb) {
    const int parent = LimbAt(model, limb).parent;
    if (!IsDriven(limb) || !IsDriven(parent) || !StartsWith(LimbAt(model, limb), DofKind::kHinge)) {
      return;
    }
    const Vector3d hinge =
        LimbAt(model, limb).rest_in_parent.rotation * LimbAt(model, limb).dofs.front().axis;
    if (StartsWith(LimbAt(model, parent), DofKind::kSwing)) {
      const Matrix3d frame = FrameOf(parent);
      const Vector3d axis = frame.transpose() * BendAxis(parent, limb, frame * hinge);
      if (axis.norm() > 0.0) {
        FrameOf(parent) =
            Twisted(frame, std::atan2(axis.y(), axis.x()) - std::atan2(hinge.y(), hinge.x()));
      }
    }
    if (drivers_.Find(limb)->is_straight) {
      FrameOf(limb) = WithFront(FrameOf(limb), FrameOf(parent).col(0));
    }
  }

  Eigen::Index frame_count_;
  std::vector<DrivenLimb> limbs_;
  ZeroStance stance_;
  JointPaths paths_;
  Drivers drivers_;
};

/// Of the bones that the file gives, by the model's.
double ScaleOf(LimbPaths& paths, const BodyModel& model) {
  paths.SeekZero();
  double of_file_m = 0.0, of_model_m = 0.0;
  for (int limb = 1; limb < model.limb_count(); ++limb) {
    if (!paths.IsDriven(limb) || !paths.IsBone(limb)) continue;
    of_file_m += (*paths.End_m(limb) - paths.Start_m(limb)).norm();
    of_model_m += LimbAt(model, limb).shape.length_m;
  }
  if (of_file_m < kShortest_m) {
    throw config::ConfigError("the motion's limbs have no length");
  }
  const double scale = of_file_m / of_model_m;
  if (scale < kSmallest || scale > kLargest) {
    throw config::ConfigError("its limbs are " + std::to_string(scale) +
                              " times as long as usual: is the unit of its lengths another one?");
  }
  return scale;
}

std::vector<Limb> Scaled(std::vector<Limb> limbs, double scale) {
  for (Limb& limb : limbs) {
    limb.rest_in_parent.translation_m *= scale;
    geometry::DegenerateCylinder& shape = limb.shape;
    for (double* length : {&shape.a0_m, &shape.b0_m, &shape.a1_m, &shape.b1_m, &shape.length_m}) {
      *length *= scale;
    }
    shape.centre0_m *= scale;
    shape.centre1_m *= scale;
  }
  return limbs;
}

/// Where the base limb begins: hips hang on it as the model's do.
Vector3d BaseOrigin_m(const LimbPaths& paths, const BodyModel& model) {
  const auto hips_m = paths.MiddleOfHips();
  const auto thigh = model.Find("right_thigh");
  if (!hips_m || !thigh) return paths.Start_m(0);
  const Vector3d& in_base = LimbAt(model, *thigh).rest_in_parent.translation_m;
  return *hips_m - paths.Orientation(0) * Vector3d(in_base.x(), 0.0, in_base.z());
}

/// Of its bone; of a limb that does not stand along it the part that goes its way.
double LengthOf_m(const LimbPaths& paths, int limb, const Vector3d& start_m) {
  const auto end_m = paths.End_m(limb);
  if (!end_m) return 0.0;
  const Vector3d bone = *end_m - start_m;
  return paths.IsBone(limb) ? bone.norm() : bone.dot(paths.Orientation(limb).col(2));
}

/// Joint positions in their parents and lengths as in the file, means over its frames.
std::vector<Limb> Measured(LimbPaths& paths, const BodyModel& model) {
  std::vector<Limb> limbs = model.limbs();
  std::vector<Vector3d> offsets_m(limbs.size(), Vector3d::Zero());
  std::vector<double> lengths_m(limbs.size(), 0.0);
  const double share = 1.0 / static_cast<double>(paths.frame_count());
  for (Eigen::Index frame = 0; frame < paths.frame_count(); ++frame) {
    paths.Seek(frame);
    const Vector3d base_m = BaseOrigin_m(paths, model);
    for (int limb = 0; limb < model.limb_count(); ++limb) {
      const auto i = static_cast<std::size_t>(limb);
      const int parent = limbs[i].parent;
      if (!paths.IsDriven(limb)) continue;
      if (paths.IsDriven(parent)) {
        const Vector3d from_m = parent == 0 ? base_m : paths.Start_m(parent);
        offsets_m[i] +=
            share * (paths.Orientation(parent).transpose() * (paths.Start_m(limb) - from_m));
      }
      lengths_m[i] += share * LengthOf_m(paths, limb, limb == 0 ? base_m : paths.Start_m(limb));
    }
  }
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (lengths_m[i] > kShortest_m) limbs[i].shape.length_m = lengths_m[i];
    if (paths.IsDriven(static_cast<int>(i)) && paths.IsDriven(limbs[i].parent)) {
      limbs[i].rest_in_parent.translation_m = offsets_m[i];
    }
  }
  return limbs;
}

BodyPose PoseAt(const LimbPaths& paths, const BodyModel& model, BodyPose pose) {
  std::vector<Matrix3d> reached(model.limbs().size());
  reached[0] = paths.Orientation(0);
  pose.frame_from_root = {Eigen::Quaterniond(reached[0]), BaseOrigin_m(paths, model)};
  for (int i = 1; i < model.limb_count(); ++i) {
    const Limb& limb = LimbAt(model, i);
    const Matrix3d& parent = reached[static_cast<std::size_t>(limb.parent)];
    auto angles =
        pose.angles_rad.segment(model.first_angle(i), static_cast<Eigen::Index>(limb.dofs.size()));
    if (paths.IsDriven(i)) {
      angles = JointAngles(limb, parent.transpose() * paths.Orientation(i));
    }
    reached[static_cast<std::size_t>(i)] = parent * body_model::ParentFromLimb(limb, angles);
  }
  return pose;
}

/// Adds one frame's distances between the model's joints and the file's.
class ErrorCount {
 public:
  ErrorCount(const LimbPaths& paths, const BodyModel& model) {
    for (int limb = 1; limb < model.limb_count(); ++limb) {
      if (!paths.IsDriven(limb)) continue;
      limbs_.push_back(limb);
      errors_.push_back({LimbAt(model, limb).name, 0.0, 0.0});
    }
  }
  void Add(const LimbPaths& paths, const Kinematics& kinematics) {
    for (std::size_t i = 0; i < limbs_.size(); ++i) {
      const int limb = limbs_[i];
      double error_m = (kinematics.proximal_m(limb) - paths.Start_m(limb)).norm();
      if (paths.IsBone(limb)) {
        error_m = std::max(error_m, (kinematics.distal_m(limb) - *paths.End_m(limb)).norm());
      }
      errors_[i].mean_m += error_m / static_cast<double>(paths.frame_count());
      errors_[i].largest_m = std::max(errors_[i].largest_m, error_m);
    }
  }
  const std::vector<JointError>& errors() const { return errors_; }

 private:
  std::vector<int> limbs_;
  std::vector<JointError> errors_;
};

}  // namespace

Retargeted Retarget(const motion::Clip& clip, const SkeletonMap& map, const BodyModel& model) {
  if (clip.frames.rows() == 0) throw config::ConfigError("the motion has no frames");
  LimbPaths paths(clip, map, model);
  const double scale = ScaleOf(paths, model);
  const BodyModel alike(model.name(), Scaled(model.limbs(), scale));
  Retargeted made{
      {BodyModel(model.name(), Measured(paths, alike)), clip.frame_rate_hz, {}}, {}, {}, scale};
  const BodyModel& person = made.motion.model;
  Kinematics kinematics(person);
  ErrorCount errors(paths, person);
  const BodyPose standing = Standing(person);
  for (Eigen::Index frame = 0; frame < paths.frame_count(); ++frame) {
    paths.Seek(frame);
    made.motion.poses.push_back(PoseAt(paths, person, standing));
    kinematics.Update(made.motion.poses.back());
    errors.Add(paths, kinematics);
  }
  made.errors = errors.errors();
  for (int limb = 1; limb < person.limb_count(); ++limb) {
    if (!paths.IsDriven(limb)) made.at_rest.push_back(LimbAt(person, limb).name);
  }
  return made;
}

}  // namespace deixis::retargeting
