#include "services/pose_fitter/core/limb_icp/limb_icp.h"

#include <algorithm>
#include <cmath>

#include "common/body_model/joint_angles.h"
#include "common/config/config.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyPose;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kBent = 0.2;  // Sine of the bend from which on a child tells its parent's twist.

/// Of a joint that can only bend, the hinge that does.
const body_model::DegreeOfFreedom* BendOf(const body_model::Limb& limb) {
  for (const auto& dof : limb.dofs) {
    if (dof.kind == body_model::DofKind::kSwing) return nullptr;
    if (dof.kind == body_model::DofKind::kHinge && std::abs(dof.axis.z()) < 0.5) return &dof;
  }
  return nullptr;
}

void Clamp(const body_model::Limb& limb, int first_angle, BodyPose& pose) {
  for (const auto& dof : limb.dofs) {
    double& angle = pose.angles_rad[first_angle++];
    angle = std::clamp(angle, dof.angle_min_rad, dof.angle_max_rad);
  }
}

}  // namespace

void LimbIcpConfig::Validate() const {
  config::Faults faults;
  faults.Require(iterations >= 1 && iterations <= 1000, "iterations", "must be 1..1000");
  faults.Require(reach_m > 0.0, "reach_m", "must be positive");
  faults.Require(equal_m >= 0.0, "equal_m", "must not be negative");
  faults.Require(least_change_m >= 0.0, "least_change_m", "must not be negative");
  faults.Require(least_points >= 3, "least_points", "must be at least 3");
  faults.Require(connected_m > 0.0, "connected_m", "must be positive");
  faults.Require(judged_scale_m > 0.0, "judged_scale_m", "must be positive");
  faults.ThrowIfAny();
}

LimbIcp::LimbIcp(const LimbIcpConfig& config, const body_model::BodyModel& model)
    : config_(config),
      model_(&model),
      kinematics_(model),
      matches_(model),
      outline_(OutlineConfig{}, model),
      trunk_(TrunkOf(model)) {
  const auto count = static_cast<std::size_t>(model.limb_count());
  alone_.resize(count, Eigen::Isometry3d::Identity());
  placed_.resize(count, Eigen::Isometry3d::Identity());
  result_.limbs.resize(count);
}

const FitResult& LimbIcp::Fit(const BodyEvidence& evidence,
                              const std::optional<body_model::Floor>& /*floor*/,
                              const BodyPose& /*predicted*/, std::optional<double> /*seconds*/,
                              BodyPose& pose) {
  const BodyPoints& points = evidence.points();
  Fit(points, pose);
  double cost = 0.0;
  for (int limb = 0; limb < model_->limb_count(); ++limb) {
    LimbEvidence& found = result_.limbs[static_cast<std::size_t>(limb)];
    found.view = outline_.Look(evidence, kinematics_, limb);
    const double squared_m2 = found.residual_m * found.residual_m;
    const double scale_m2 = config_.judged_scale_m * config_.judged_scale_m;
    cost += found.inlier_count * squared_m2 / (scale_m2 + squared_m2);
  }
  const auto& nearest = winners();
  const auto none = std::count(nearest.begin(), nearest.end(), -1);
  Score(trunk_, points.count(), points.count() - static_cast<int>(none), cost, result_);
  return result_;
}

const FitResult& LimbIcp::Fit(const BodyPoints& points, BodyPose& pose) {
  const MatchSettings settings{config_.reach_m, config_.equal_m};
  kinematics_.Update(pose);
  matches_.Find(points, kinematics_, settings);
  for (cycles_ = 0; cycles_ < config_.iterations;) {
    ++cycles_;
    const double change_m = MoveLimbs(pose);
    kinematics_.Update(pose);
    matches_.Find(points, kinematics_, settings);
    if (change_m <= config_.least_change_m) break;
  }
  Describe();
  return result_;
}

double LimbIcp::MoveLimbs(BodyPose& pose) {
  MoveAlone();
  for (int limb = 0; limb < model_->limb_count(); ++limb) Connect(limb, pose);
  const Vector3d shift_m = Shift_m();
  pose.frame_from_root.translation_m += shift_m;
  for (auto& placed : placed_) placed.translation() += shift_m;
  return Change_m();
}

void LimbIcp::MoveAlone() {
  for (int limb = 0; limb < model_->limb_count(); ++limb) {
    const auto k = static_cast<std::size_t>(limb);
    const PairSums& pairs = matches_.pairs(limb);
    const int parent = model_->limbs()[k].parent;
    alone_[k] = kinematics_.limb(limb);
    if (pairs.count >= config_.least_points) {
      alone_[k] = alone_[k] * RigidMotion(pairs);
    } else if (parent >= 0) {
      alone_[k] = alone_[static_cast<std::size_t>(parent)] * kinematics_.limb(parent).inverse() *
                  kinematics_.limb(limb);
    }
  }
}

// The source tests whether the limb still begins where its parent ends. Here it is put there with
// the orientation that it has found, unless it was drawn off its joint: then with its old angles.
void LimbIcp::Connect(int limb, BodyPose& pose) {
  const auto k = static_cast<std::size_t>(limb);
  const body_model::Limb& shape = model_->limbs()[k];
  const Matrix3d wanted = TwistedForChild(limb, alone_[k].linear());
  if (shape.parent < 0) {
    pose.frame_from_root.translation_m = alone_[k].translation();
    pose.frame_from_root.rotation = Eigen::Quaterniond(wanted).normalized();
    placed_[k].linear() = pose.frame_from_root.rotation.toRotationMatrix();
    placed_[k].translation() = alone_[k].translation();
    return;
  }
  const auto parent = static_cast<std::size_t>(shape.parent);
  const int first = model_->first_angle(limb);
  const auto dofs = static_cast<Eigen::Index>(shape.dofs.size());
  const Vector3d& origin_m = shape.rest_in_parent.translation_m;
  const double gap_m = (alone_[k].translation() - alone_[parent] * origin_m).norm();
  if (gap_m <= config_.connected_m && matches_.pairs(limb).count >= config_.least_points) {
    pose.angles_rad.segment(first, dofs) =
        body_model::JointAngles(shape, placed_[parent].linear().transpose() * wanted);
    Clamp(shape, first, pose);
  }
  placed_[k].linear() = placed_[parent].linear() *
                        body_model::ParentFromLimb(shape, pose.angles_rad.segment(first, dofs));
  placed_[k].translation() = placed_[parent] * origin_m;
}

// The points of a round limb do not tell how it is turned about its axis; the direction into which
// the hinge at its end is bent does.
Matrix3d LimbIcp::TwistedForChild(int limb, const Matrix3d& frame_from_limb) const {
  const auto& shape = model_->limbs()[static_cast<std::size_t>(limb)];
  const auto& children = model_->children(limb);
  if (shape.dofs.size() != 3 || children.size() != 1) return frame_from_limb;
  const auto child = static_cast<std::size_t>(children.front());
  const auto& bent = model_->limbs()[child];
  const auto* hinge = BendOf(bent);
  if (hinge == nullptr || matches_.pairs(children.front()).count < config_.least_points) {
    return frame_from_limb;
  }
  const Vector3d is = frame_from_limb.transpose() * alone_[child].linear().col(2);
  if (is.head<2>().norm() < kBent) return frame_from_limb;
  const Vector3d axis = bent.rest_in_parent.rotation * hinge->axis;
  const double sign = hinge->angle_max_rad >= -hinge->angle_min_rad ? 1.0 : -1.0;
  const Vector3d should = sign * axis.cross(Vector3d::UnitZ());
  const double turn_rad = std::atan2(is.y(), is.x()) - std::atan2(should.y(), should.x());
  return frame_from_limb * Eigen::AngleAxisd(turn_rad, Vector3d::UnitZ()).toRotationMatrix();
}

// Connected limbs lie beside their points where others, on which they hang, slid along theirs: the
// whole body goes to where it is nearest to all.
Vector3d LimbIcp::Shift_m() const {
  Vector3d sum_m = Vector3d::Zero();
  int count = 0;
  for (int limb = 0; limb < model_->limb_count(); ++limb) {
    const PairSums& pairs = matches_.pairs(limb);
    if (pairs.count < config_.least_points) continue;
    const auto k = static_cast<std::size_t>(limb);
    const Vector3d middle_m = pairs.from_m / pairs.count;
    sum_m += pairs.count * (alone_[k] * middle_m - placed_[k] * middle_m);
    count += pairs.count;
  }
  return count > 0 ? Vector3d(sum_m / count) : Vector3d::Zero();
}

double LimbIcp::Change_m() const {
  double change_m = 0.0;
  for (int limb = 0; limb < model_->limb_count(); ++limb) {
    const auto k = static_cast<std::size_t>(limb);
    const Vector3d end_m(0.0, 0.0, model_->limbs()[k].shape.length_m);
    change_m = std::max({change_m, (placed_[k].translation() - kinematics_.proximal_m(limb)).norm(),
                         (placed_[k] * end_m - kinematics_.limb(limb) * end_m).norm()});
  }
  return change_m;
}

void LimbIcp::Describe() {
  for (int limb = 0; limb < model_->limb_count(); ++limb) {
    const PairSums& pairs = matches_.pairs(limb);
    LimbEvidence& found = result_.limbs[static_cast<std::size_t>(limb)];
    found = {};
    found.inlier_count = pairs.count;
    if (pairs.count > 0) found.residual_m = std::sqrt(pairs.squared_m2 / pairs.count);
  }
}

}  // namespace deixis::pose_fitter
