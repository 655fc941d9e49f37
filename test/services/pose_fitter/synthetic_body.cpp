#include "test/services/pose_fitter/synthetic_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"

namespace deixis::pose_fitter::test {
namespace {

using body_model::BodyModel;
using body_model::BodyPose;
using Eigen::Vector3d;

constexpr double kFarthest_m = 10.0;

/// Distance along the ray (from the camera's centre, of any length) at which it meets the limb;
/// infinite where it does not.
double Meet(const geometry::DegenerateCylinder& shape, const Eigen::Isometry3d& camera_from_limb,
            const Vector3d& ray) {
  const Vector3d begin_m = camera_from_limb.inverse().translation();
  const Vector3d along = camera_from_limb.linear().transpose() * ray.normalized();
  double way_m = std::max(0.0, camera_from_limb.translation().norm() - 1.0);
  for (int step = 0; step < 100 && way_m < kFarthest_m; ++step) {
    const double distance_m = FindClosest(shape, begin_m + way_m * along).signed_distance_m;
    if (distance_m < 1e-5) return way_m / ray.norm();
    way_m += distance_m;
  }
  return std::numeric_limits<double>::infinity();
}

cv::Rect BoxOf(const geometry::DegenerateCylinder& shape, const Eigen::Isometry3d& frame,
               const DepthCamera& camera) {
  const Vector3d middle_m = frame * Vector3d(0.0, 0.0, 0.5 * shape.length_m);
  const double radius_m = std::hypot(
      0.5 * shape.length_m, 2.0 * std::max({shape.a0_m, shape.b0_m, shape.a1_m, shape.b1_m}));
  const Eigen::Vector2d centre = camera.Project(middle_m);
  const double extent = camera.focal_px.x() * radius_m / (middle_m.z() - radius_m);
  return cv::Rect(cv::Point(static_cast<int>(centre.x() - extent),
                            static_cast<int>(centre.y() - extent)),
                  cv::Point(static_cast<int>(centre.x() + extent),
                            static_cast<int>(centre.y() + extent))) &
         cv::Rect(0, 0, camera.width_px, camera.height_px);
}

DepthCamera CameraOf(int width_px) {
  DepthCamera camera;
  camera.width_px = width_px;
  camera.height_px = width_px * 3 / 4;
  camera.focal_px = Eigen::Vector2d::Constant(0.5 * width_px / std::tan(25.0 * M_PI / 180.0));
  camera.centre_px = {0.5 * (camera.width_px - 1), 0.5 * (camera.height_px - 1)};
  camera.noise.per_square_m = 0.001;
  return camera;
}

void Bend(const BodyModel& model, const std::string& limb, double angle_rad, BodyPose& pose) {
  const auto index = model.Find(limb);
  if (!index) return;
  const auto& bent = model.limbs()[static_cast<std::size_t>(*index)];
  for (std::size_t i = 0; i < bent.dofs.size(); ++i) {
    if (bent.dofs[i].name != "flexion") continue;
    pose.angles_rad[model.first_angle(*index) + static_cast<int>(i)] = angle_rad;
  }
}

}  // namespace

BodyMaker MakerOf(const std::string& plan) {
  setenv("DEIXIS_CONFIG_DIR", DEIXIS_SOURCE_DIR "/config", 1);
  return BodyMaker("body_models/" + plan + ".yaml");
}

BodyModel BodyOf(const std::string& plan) { return MakerOf(plan).Make(1.75, 0.01).model; }

BodyPose Gesturing(const BodyModel& model) {
  BodyPose pose = body_model::Standing(model);
  Eigen::Matrix3d camera_from_root;
  camera_from_root << 0, 1, 0, 0, 0, -1, -1, 0, 0;
  pose.frame_from_root.rotation = Eigen::Quaterniond(camera_from_root);
  pose.frame_from_root.translation_m = {0.0, 0.15, 2.5};
  if (const auto arm = model.Find("right_upper_arm")) {
    body_model::PointLimb(model, *arm, {0.3, -0.8, -0.4}, pose);
  }
  if (const auto arm = model.Find("left_upper_arm")) {
    body_model::PointLimb(model, *arm, {0.2, 0.7, -0.7}, pose);
  }
  Bend(model, "right_lower_arm", 0.8, pose);
  Bend(model, "left_lower_arm", 1.2, pose);
  return pose;
}

double JointError_m(const BodyModel& model, const BodyPose& one, const BodyPose& other) {
  body_model::Kinematics a(model), b(model);
  a.Update(one);
  b.Update(other);
  double sum_m = 0.0;
  for (int limb = 0; limb < model.limb_count(); ++limb) {
    sum_m += 0.5 * (a.proximal_m(limb) - b.proximal_m(limb)).norm();
    sum_m += 0.5 * (a.distal_m(limb) - b.distal_m(limb)).norm();
  }
  return sum_m / model.limb_count();
}

BodyPose Disturbed(const BodyModel& model, const BodyPose& pose, double mean_error_m,
                   std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto draw = [&](double sigma) { return sigma * normal(random); };
  const Vector3d shift_m(draw(0.3), draw(0.3), draw(0.3));
  const Vector3d turn_rad(draw(0.3), draw(0.3), draw(0.3));
  Eigen::VectorXd angles_rad(model.angle_count());
  for (double& angle : angles_rad) angle = draw(1.0);
  const auto at = [&](double share) {
    BodyPose off = pose;
    off.frame_from_root.translation_m += share * shift_m;
    off.frame_from_root.rotation = Eigen::Quaterniond(body_model::RotationFrom(share * turn_rad)) *
                                   pose.frame_from_root.rotation;
    off.angles_rad += share * angles_rad;
    body_model::ClampToEnvelope(model, off);
    return off;
  };
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (JointError_m(model, pose, at(middle)) < mean_error_m ? low : high) = middle;
  }
  return at(low);
}

BodyPicture Look(const BodyModel& model, const BodyPose& pose, int width_px, double noise_m) {
  BodyPicture picture{CameraOf(width_px), {}};
  const DepthCamera& camera = picture.camera;
  cv::Mat depth_m(camera.height_px, camera.width_px, CV_64FC1,
                  cv::Scalar(std::numeric_limits<double>::infinity()));
  body_model::Kinematics kinematics(model);
  kinematics.Update(pose);
  for (int limb = 0; limb < model.limb_count(); ++limb) {
    const auto& shape = model.limbs()[static_cast<std::size_t>(limb)].shape;
    const cv::Rect box = BoxOf(shape, kinematics.limb(limb), camera);
    for (int v = box.y; v < box.y + box.height; ++v) {
      for (int u = box.x; u < box.x + box.width; ++u) {
        double& nearest_m = depth_m.at<double>(v, u);
        nearest_m = std::min(nearest_m, Meet(shape, kinematics.limb(limb), camera.Ray(u, v)));
      }
    }
  }
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  picture.depth_mm.create(depth_m.size(), CV_16UC1);
  for (int i = 0; i < static_cast<int>(depth_m.total()); ++i) {
    const double z_m = depth_m.at<double>(i);
    picture.depth_mm.at<std::uint16_t>(i) =
        std::isfinite(z_m)
            ? static_cast<std::uint16_t>(std::lround(1000.0 * (z_m + noise_m * normal(random))))
            : std::uint16_t{0};
  }
  return picture;
}

BodyPoints PointsOf(const BodyPicture& picture) {
  constexpr int kTile = 8;
  DepthView view;
  view.Update(picture.camera, picture.depth_mm);
  BodyPoints points;
  for (int tile = 0; tile < view.width_px() * view.height_px() / kTile / kTile; ++tile) {
    const int across = view.width_px() / kTile;
    for (int i = 0; i < kTile * kTile; ++i) {
      const int u = tile % across * kTile + i % kTile, v = tile / across * kTile + i / kTile;
      if (v >= view.height_px() || view.z_m(u, v) <= 0.0F) continue;
      points.Add(
          view.Point(u, v).cast<float>(),
          static_cast<float>(picture.camera.noise.Sigma_m(static_cast<double>(view.z_m(u, v)))));
    }
    points.EndBlock();
  }
  return points;
}

}  // namespace deixis::pose_fitter::test
