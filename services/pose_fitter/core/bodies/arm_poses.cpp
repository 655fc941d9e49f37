#include "services/pose_fitter/core/bodies/arm_poses.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;
using body_model::BodyPose;
using Eigen::Vector3d;

/// Directions of a right arm in the trunk's frame: x anterior, y to the left, z cranial.
struct ArmDirections {
  Vector3d upper, lower;
};

const std::vector<ArmDirections>& Places() {
  static const std::vector<ArmDirections> places{
      {{0.0, -0.1, -1.0}, {0.1, 0.0, -1.0}},   // Hanging.
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
      {0.1, 0.9, 0.4}, {1.0, 0.2, 0.0}, {0.2, 0.0, 1.0}, {0.2, 0.0, -1.0}};
  return places;
}

/// Elbows bend about the y axis of the upper arm alone: its x axis turns to where the forearm goes.
void Point(const BodyModel& model, int upper, int lower, const Vector3d& upper_direction,
           const Vector3d& lower_direction, BodyPose& pose) {
  const Vector3d z = upper_direction.normalized();
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

}  // namespace

std::vector<BodyPose> ArmPoses(const BodyModel& model, const BodyPose& pose, ArmSide side) {
  const std::string name = side == ArmSide::kRight ? "right_" : "left_";
  const auto upper = model.Find(name + "upper_arm"), lower = model.Find(name + "lower_arm");
  if (!upper || !lower) return {};
  const int clavicle = model.limbs()[static_cast<std::size_t>(*upper)].parent;
  const int trunk = std::max(0, model.limbs()[static_cast<std::size_t>(clavicle)].parent);
  body_model::Kinematics kinematics(model);
  kinematics.Update(pose);
  const Eigen::Matrix3d frame_from_trunk = kinematics.limb(trunk).linear();
  const auto direction = [&](Vector3d in_trunk) {
    if (side == ArmSide::kLeft) in_trunk.y() = -in_trunk.y();
    return Vector3d(frame_from_trunk * in_trunk);
  };
  std::vector<BodyPose> poses;
  for (const ArmDirections& place : Places()) {
    BodyPose& other = poses.emplace_back(pose);
    Point(model, *upper, *lower, direction(place.upper), direction(place.lower), other);
    body_model::ClampToEnvelope(model, other);
  }
  for (const Vector3d& place : ForearmPlaces()) {
    BodyPose& other = poses.emplace_back(pose);
    Point(model, *upper, *lower, kinematics.limb(*upper).linear().col(2), direction(place), other);
    body_model::ClampToEnvelope(model, other);
  }
  return poses;
}

}  // namespace deixis::pose_fitter
