#include "services/pose_fitter/core/bodies/limb_poses.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;
using body_model::BodyPose;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kSwivels = 8;

/// Directions of a right limb's two parts: x anterior, y to the left, z cranial.
struct Directions {
  Vector3d upper, lower;
};

const std::vector<Directions>& ArmPlaces() {
  static const std::vector<Directions> places{
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

const std::vector<Directions>& LegPlaces() {
  static const std::vector<Directions> places{
      {{0.05, -0.05, -1.0}, {0.0, -0.05, -1.0}},  // Standing.
      {{0.0, -0.3, -1.0}, {0.0, -0.2, -1.0}},     // Legs apart.
      {{0.4, -0.05, -1.0}, {0.1, 0.0, -1.0}},     // A step forward
      {{-0.2, -0.05, -1.0}, {-0.5, 0.0, -1.0}},   // and back.
      {{0.8, -0.1, -0.6}, {-0.2, 0.0, -1.0}},     // Knee raised.
      {{1.0, -0.2, -0.1}, {0.0, 0.0, -1.0}},      // Seated.
      {{0.9, -0.4, -0.3}, {-0.6, 0.0, -0.8}},     // Squatting.
      {{0.1, 0.0, -1.0}, {-1.0, 0.0, -0.1}}};     // Kneeling.
  return places;
}

const std::vector<Vector3d>& ForearmPlaces() {
  static const std::vector<Vector3d> places{
      {0.1, 0.9, 0.4}, {1.0, 0.2, 0.0}, {0.2, 0.0, 1.0}, {0.2, 0.0, -1.0}, {0.2, 0.9, -0.4}};
  return places;
}

Vector3d OfSide(const Vector3d& of_right, Chain chain) {
  return IsRight(chain) ? of_right : Vector3d(of_right.x(), -of_right.y(), of_right.z());
}

/// Directions are in the pose's frame. Elbows and knees bend about the y axis of the upper limb
/// alone, elbows forward, knees backward: its x axis turns accordingly.
void Point(const BodyModel& model, const ChainLimbs& limbs, const Vector3d& upper_in_frame,
           const Vector3d& lower_in_frame, BodyPose& pose) {
  const Eigen::Quaterniond root_from_frame = pose.frame_from_root.rotation.conjugate();
  const Vector3d z = root_from_frame * upper_in_frame.normalized();
  const Vector3d lower = root_from_frame * lower_in_frame;
  Vector3d x = (lower - lower.dot(z) * z) * (IsArm(limbs.chain) ? 1.0 : -1.0);
  if (x.norm() > 1e-3) {
    x.normalize();
    Matrix3d axes;
    axes << x, z.cross(x), z;
    body_model::OrientLimb(model, limbs.upper, axes, pose);
  } else {
    body_model::PointLimb(model, limbs.upper, z, pose);
  }
  body_model::PointLimb(model, limbs.lower, lower, pose);
  body_model::ClampToEnvelope(model, pose);
}

/// What directions of places refer to: the trunk for arms, an upright pelvis for legs.
Matrix3d AxesOf(const body_model::Kinematics& kinematics, const ChainLimbs& limbs,
                const Vector3d& up) {
  const Matrix3d trunk = kinematics.limb(limbs.trunk).linear();
  if (IsArm(limbs.chain)) return trunk;
  // Who lies or bends over has his front where it would be if he rose.
  Vector3d left = trunk.col(1) - up.dot(trunk.col(1)) * up;
  if (left.norm() < 1e-3) return trunk;
  left.normalize();
  Matrix3d axes;
  axes << left.cross(up), left, up;
  return axes;
}

}  // namespace

std::vector<BodyPose> UsualPoses(const BodyModel& model, const ChainLimbs& limbs,
                                 const BodyPose& pose, const Vector3d& up) {
  body_model::Kinematics kinematics(model);
  kinematics.Update(pose);
  const Matrix3d axes = AxesOf(kinematics, limbs, up);
  const auto direction = [&](const Vector3d& of_right) {
    return Vector3d(axes * OfSide(of_right, limbs.chain));
  };
  std::vector<BodyPose> poses;
  for (const Directions& place : IsArm(limbs.chain) ? ArmPlaces() : LegPlaces()) {
    Point(model, limbs, direction(place.upper), direction(place.lower), poses.emplace_back(pose));
  }
  if (!IsArm(limbs.chain)) return poses;
  for (const Vector3d& place : ForearmPlaces()) {
    Point(model, limbs, kinematics.limb(limbs.upper).linear().col(2), direction(place),
          poses.emplace_back(pose));
  }
  return poses;
}

std::vector<BodyPose> ReachingPoses(const BodyModel& model, const ChainLimbs& limbs,
                                    const BodyPose& pose, const Vector3d& end_m) {
  body_model::Kinematics kinematics(model);
  kinematics.Update(pose);
  const Vector3d from_m = kinematics.proximal_m(limbs.upper);
  const double a = limbs.upper_m, b = limbs.lower_m;
  const double far_m = (end_m - from_m).norm();
  if (far_m < 1e-3) return {};
  const Vector3d towards = (end_m - from_m) / far_m;
  const double reach_m = std::clamp(far_m, std::abs(a - b) + 0.01, 0.995 * (a + b));
  // Where the circle of the elbow lies, and its radius.
  const double along_m = (a * a - b * b + reach_m * reach_m) / (2.0 * reach_m);
  const double off_m = std::sqrt(std::max(0.0, a * a - along_m * along_m));
  const Vector3d across = towards.unitOrthogonal();
  std::vector<BodyPose> poses;
  for (int i = 0; i < kSwivels; ++i) {
    const Eigen::AngleAxisd swivel(2.0 * M_PI * i / kSwivels, towards);
    const Vector3d upper_m = along_m * towards + off_m * (swivel * across);
    Point(model, limbs, upper_m, reach_m * towards - upper_m, poses.emplace_back(pose));
  }
  return poses;
}

std::vector<BodyPose> ElbowPoses(const BodyModel& model, const ChainLimbs& limbs,
                                 const BodyPose& pose, const Vector3d& elbow_m) {
  body_model::Kinematics kinematics(model);
  kinematics.Update(pose);
  const Vector3d upper_m = elbow_m - kinematics.proximal_m(limbs.upper);
  if (upper_m.norm() < 1e-3) return {};
  const Matrix3d trunk = kinematics.limb(limbs.trunk).linear();
  std::vector<BodyPose> poses;
  for (const Vector3d& place : ForearmPlaces()) {
    Point(model, limbs, upper_m, trunk * OfSide(place, limbs.chain), poses.emplace_back(pose));
  }
  return poses;
}

}  // namespace deixis::pose_fitter
