#include "services/pose_fitter/core/start/start_poses.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyPose;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kDirections = 8;
constexpr double kInside_m = 0.09;  // The root lies this far behind the surface that is seen.
constexpr double kStandingShare = 0.9;

/// Of the person's highest limb above its root, in a pose with the root at the origin.
double Top_m(const body_model::BodyModel& model, const BodyPose& pose) {
  body_model::Kinematics kinematics(model);
  kinematics.Update(pose);
  double top_m = 0.0;
  for (int i = 0; i < model.limb_count(); ++i) {
    top_m = std::max(top_m, kinematics.distal_m(i).z());
  }
  return top_m;
}

double Bottom_m(const body_model::BodyModel& model, const BodyPose& pose) {
  body_model::Kinematics kinematics(model);
  kinematics.Update(pose);
  double bottom_m = 0.0;
  for (int i = 0; i < model.limb_count(); ++i) {
    bottom_m = std::min(bottom_m, kinematics.distal_m(i).z());
  }
  return bottom_m;
}

BodyPose Seated(const body_model::BodyModel& model, BodyPose pose) {
  for (const char* side : {"right_", "left_"}) {
    const auto thigh = model.Find(std::string(side) + "thigh");
    const auto shank = model.Find(std::string(side) + "shank");
    if (thigh) body_model::PointLimb(model, *thigh, Vector3d(1.0, 0.0, -0.1), pose);
    if (shank) body_model::PointLimb(model, *shank, Vector3d(0.0, 0.0, -1.0), pose);
  }
  return pose;
}

Vector3d UpOf(const std::optional<body_model::Floor>& floor) {
  return floor ? floor->normal : Vector3d(-Vector3d::UnitY());
}

}  // namespace

std::vector<BodyPose> StartPoses(const body_model::BodyModel& model, const Vector3d& head_top_m,
                                 const std::optional<body_model::Floor>& floor) {
  const Vector3d up = UpOf(floor);
  const BodyPose standing = body_model::Standing(model);
  const double standing_top_m = Top_m(model, standing);
  const double height_m = standing_top_m - Bottom_m(model, standing);
  std::vector<BodyPose> postures{standing};
  const double above_floor_m = floor ? up.dot(head_top_m) + floor->offset_m : 0.0;
  if (above_floor_m < kStandingShare * height_m) postures.push_back(Seated(model, standing));
  Vector3d to_camera = -(head_top_m - up * up.dot(head_top_m));
  to_camera.normalize();
  std::vector<BodyPose> poses;
  for (const BodyPose& posture : postures) {
    for (int k = 0; k < kDirections; ++k) {
      const Vector3d forward = Eigen::AngleAxisd(2.0 * M_PI * k / kDirections, up) * to_camera;
      Matrix3d axes;
      axes << forward, up.cross(forward), up;
      BodyPose pose = posture;
      pose.frame_from_root.rotation = Eigen::Quaterniond(axes);
      pose.frame_from_root.translation_m = head_top_m - kInside_m * to_camera - standing_top_m * up;
      poses.push_back(pose);
    }
  }
  return poses;
}

}  // namespace deixis::pose_fitter
