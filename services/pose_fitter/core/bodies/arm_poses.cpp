#include "services/pose_fitter/core/bodies/arm_poses.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;
using body_model::BodyPose;
using Eigen::Vector3d;

constexpr int kSwivels = 8;
constexpr double kHandShare = 0.35;  // Of a hand, from the wrist to its middle.

/// Directions of a right arm in the trunk's frame: x anterior, y to the left, z cranial.
struct ArmDirections {
  Vector3d upper, lower;
};

const std::vector<ArmDirections>& Places() {
  static const std::vector<ArmDirections> places{
      {{0.0, -0.1, -1.0}, {0.1, -0.1, -1.0}},  // Hanging.
      {{0.0, -0.4, -1.0}, {0.1, -0.4, -1.0}},  // Away from the trunk.
      {{0.2, -0.2, -1.0}, {0.5, 0.8, 0.1}},    // Before the trunk.
      {{-0.2, -0.7, -0.7}, {0.3, 0.7, -0.6}},  // On the hip.
      {{1.0, -0.1, -0.1}, {1.0, 0.0, 0.0}},    // Forward.
      {{0.2, -1.0, 0.0}, {0.2, -1.0, 0.0}},    // To the side.
      {{0.2, -0.3, 1.0}, {0.1, 0.0, 1.0}},     // Up.
      {{0.4, -0.7, 0.3}, {0.2, 0.8, 0.5}},     // At the head.
      {{0.2, -0.5, -0.7}, {0.4, -0.1, 1.0}}};  // Waving.
  return places;
}

const std::vector<Vector3d>& ForearmPlaces() {
  static const std::vector<Vector3d> places{
      {0.1, 0.9, 0.4}, {1.0, 0.2, 0.0}, {0.2, 0.0, 1.0}, {0.2, 0.0, -1.0}, {0.2, 0.9, -0.4}};
  return places;
}

/// Directions are in the camera's frame. Elbows bend about the y axis of the upper arm alone: its x
/// axis turns to where the forearm goes.
void Point(const BodyModel& model, int upper, int lower, const Vector3d& upper_in_frame,
           const Vector3d& lower_in_frame, BodyPose& pose) {
  const Eigen::Quaterniond root_from_frame = pose.frame_from_root.rotation.conjugate();
  const Vector3d z = root_from_frame * upper_in_frame.normalized();
  const Vector3d lower_direction = root_from_frame * lower_in_frame;
  Vector3d x = lower_direction - lower_direction.dot(z) * z;
  if (x.norm() > 1e-3) {
    x.normalize();
    Eigen::Matrix3d axes;
    axes << x, z.cross(x), z;
    body_model::OrientLimb(model, upper, axes, pose);
  } else {
    body_model::PointLimb(model, upper, z, pose);
  }
  body_model::PointLimb(model, lower, lower_direction, pose);
}

Vector3d OfSide(const Vector3d& of_right, ArmSide side) {
  return side == ArmSide::kRight ? of_right : Vector3d(of_right.x(), -of_right.y(), of_right.z());
}

struct Arm {
  int upper = -1, lower = -1, trunk = 0;
  double upper_m = 0.0;    ///< Shoulder to elbow.
  double forearm_m = 0.0;  ///< Elbow to the middle of the hand.
};

std::optional<Arm> ArmOf(const BodyModel& model, ArmSide side) {
  const std::string name = side == ArmSide::kRight ? "right_" : "left_";
  const auto upper = model.Find(name + "upper_arm"), lower = model.Find(name + "lower_arm");
  if (!upper || !lower) return std::nullopt;
  const auto length_m = [&model](int limb) {
    return model.limbs()[static_cast<std::size_t>(limb)].shape.length_m;
  };
  const int clavicle = model.limbs()[static_cast<std::size_t>(*upper)].parent;
  const int trunk = std::max(0, model.limbs()[static_cast<std::size_t>(clavicle)].parent);
  Arm arm{*upper, *lower, trunk, length_m(*upper), length_m(*lower)};
  if (const auto hand = model.Find(name + "hand")) arm.forearm_m += kHandShare * length_m(*hand);
  return arm;
}

}  // namespace

std::vector<BodyPose> ReachingPoses(const BodyModel& model, const BodyPose& pose, ArmSide side,
                                    const Vector3d& hand_m) {
  const auto arm = ArmOf(model, side);
  if (!arm) return {};
  body_model::Kinematics kinematics(model);
  kinematics.Update(pose);
  const Vector3d shoulder_m = kinematics.proximal_m(arm->upper);
  const double a = arm->upper_m, b = arm->forearm_m;
  const double far_m = (hand_m - shoulder_m).norm();
  if (far_m < 1e-3) return {};
  const Vector3d towards = (hand_m - shoulder_m) / far_m;
  const double reach_m = std::clamp(far_m, std::abs(a - b) + 0.01, 0.995 * (a + b));
  // Where the elbow's circle lies, and its radius.
  const double along_m = (a * a - b * b + reach_m * reach_m) / (2.0 * reach_m);
  const double off_m = std::sqrt(std::max(0.0, a * a - along_m * along_m));
  const Vector3d side_axis = towards.unitOrthogonal();
  std::vector<BodyPose> poses;
  for (int i = 0; i < kSwivels; ++i) {
    const Eigen::AngleAxisd swivel(2.0 * M_PI * i / kSwivels, towards);
    const Vector3d upper = along_m * towards + off_m * (swivel * side_axis);
    BodyPose& other = poses.emplace_back(pose);
    Point(model, arm->upper, arm->lower, upper, reach_m * towards - upper, other);
    body_model::ClampToEnvelope(model, other);
  }
  return poses;
}

std::vector<BodyPose> ElbowPoses(const BodyModel& model, const BodyPose& pose, ArmSide side,
                                 const Vector3d& elbow_m) {
  const auto arm = ArmOf(model, side);
  if (!arm) return {};
  body_model::Kinematics kinematics(model);
  kinematics.Update(pose);
  const Vector3d upper = elbow_m - kinematics.proximal_m(arm->upper);
  if (upper.norm() < 1e-3) return {};
  const Eigen::Matrix3d frame_from_trunk = kinematics.limb(arm->trunk).linear();
  std::vector<BodyPose> poses;
  for (const Vector3d& place : ForearmPlaces()) {
    BodyPose& other = poses.emplace_back(pose);
    Point(model, arm->upper, arm->lower, upper, frame_from_trunk * OfSide(place, side), other);
    body_model::ClampToEnvelope(model, other);
  }
  return poses;
}

std::vector<BodyPose> ArmPoses(const BodyModel& model, const BodyPose& pose, ArmSide side) {
  const auto arm = ArmOf(model, side);
  if (!arm) return {};
  body_model::Kinematics kinematics(model);
  kinematics.Update(pose);
  const Eigen::Matrix3d frame_from_trunk = kinematics.limb(arm->trunk).linear();
  const auto direction = [&](const Vector3d& in_trunk) {
    return Vector3d(frame_from_trunk * OfSide(in_trunk, side));
  };
  std::vector<BodyPose> poses;
  for (const ArmDirections& place : Places()) {
    BodyPose& other = poses.emplace_back(pose);
    Point(model, arm->upper, arm->lower, direction(place.upper), direction(place.lower), other);
    body_model::ClampToEnvelope(model, other);
  }
  for (const Vector3d& place : ForearmPlaces()) {
    BodyPose& other = poses.emplace_back(pose);
    Point(model, arm->upper, arm->lower, kinematics.limb(arm->upper).linear().col(2),
          direction(place), other);
    body_model::ClampToEnvelope(model, other);
  }
  return poses;
}

}  // namespace deixis::pose_fitter
