#include "test/services/pose_fitter/synthetic_person.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"
#include "common/filtering/random.h"
#include "common/geometry/degenerate_cylinder.h"
#include "services/pose_fitter/core/bodies/person_body.h"

namespace deixis::pose_fitter::test {
namespace {

using body_model::BodyModel;
using body_model::BodyPose;
using body_model::Kinematics;
using Eigen::Vector3d;

/// Height of the lowest surface above the floor, metres.
double LowestOf(const Room& room, const Kinematics& kinematics) {
  const body_model::Floor floor = room.Floor();
  double lowest_m = 1e9;
  for (int limb = 0; limb < kinematics.model().limb_count(); ++limb) {
    const auto& shape = kinematics.model().limbs()[static_cast<std::size_t>(limb)].shape;
    for (int step = 0; step < 64; ++step) {
      for (const double s : {0.0, 1.0}) {
        const Vector3d point_m =
            kinematics.limb(limb) * geometry::SidePoint(shape, 2.0 * M_PI * step / 64, s);
        lowest_m = std::min(lowest_m, floor.normal.dot(point_m) + floor.offset_m);
      }
    }
  }
  return lowest_m;
}

/// A ball around the limb, and where its ray starts.
bool MayMeet(const geometry::DegenerateCylinder& shape, const Vector3d& from,
             const Vector3d& along) {
  const Vector3d middle(0.0, 0.0, 0.5 * shape.length_m);
  const double beside_m = std::max(shape.centre0_m.norm(), shape.centre1_m.norm());
  const double thick_m = std::max({shape.a0_m, shape.b0_m, shape.a1_m, shape.b1_m}) + beside_m;
  const double radius_m = std::hypot(0.5 * shape.length_m, thick_m);
  return (middle - from).cross(along).norm() <= radius_m;
}

}  // namespace

BodyModel ClothedBody(double stature_m) {
  setenv("DEIXIS_CONFIG_DIR", DEIXIS_SOURCE_DIR "/config", 1);
  return BodyMaker("body_models/clothed_body.yaml").Make(stature_m, 0.01).model;
}

BodyPose StandingIn(const Room& room, const BodyModel& body, double x_m, double y_m,
                    double abduction_rad) {
  BodyPose pose = body_model::Standing(body);
  for (const double side : {-1.0, 1.0}) {
    const auto arm = body.Find(side < 0.0 ? "right_upper_arm" : "left_upper_arm");
    const Vector3d direction(0.1, side * std::sin(abduction_rad), -std::cos(abduction_rad));
    body_model::PointLimb(body, arm.value(), direction, pose);
  }
  Eigen::Matrix3d room_from_body;
  room_from_body << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  const Eigen::Isometry3d camera_from_room = room.CameraFromRoom();
  pose.frame_from_root = {Eigen::Quaterniond(camera_from_room.linear() * room_from_body),
                          camera_from_room * Vector3d(x_m, y_m, 1.0)};
  Kinematics kinematics(body);
  kinematics.Update(pose);
  pose.frame_from_root.translation_m -= LowestOf(room, kinematics) * room.Floor().normal;
  return pose;
}

std::optional<double> DepthOn(const geometry::DegenerateCylinder& shape,
                              const Eigen::Isometry3d& camera_from_limb, const Vector3d& ray) {
  constexpr int kMostSteps = 400;
  constexpr double kMet_m = 1e-6, kFarthest_m = 20.0;
  const Vector3d from = camera_from_limb.inverse().translation();
  const Vector3d along = camera_from_limb.linear().transpose() * ray.normalized();
  if (!MayMeet(shape, from, along)) return std::nullopt;
  double gone_m = 0.0;
  for (int step = 0; step < kMostSteps && gone_m < kFarthest_m; ++step) {
    const double left_m = geometry::FindClosest(shape, from + gone_m * along).signed_distance_m;
    if (left_m < kMet_m) return gone_m / ray.norm();
    gone_m += left_m;
  }
  return std::nullopt;
}

void Draw(const BodyModel& body, const BodyPose& pose, int owner, Picture& picture) {
  Kinematics kinematics(body);
  kinematics.Update(pose);
  const filtering::CounterRandom random(17, static_cast<std::uint64_t>(owner));
  std::uint64_t pixel = 0;
  for (int v = 0; v < picture.camera.height_px; ++v) {
    for (int u = 0; u < picture.camera.width_px; ++u, ++pixel) {
      auto& seen_mm = picture.depth_mm.at<std::uint16_t>(v, u);
      double nearest_m = seen_mm == 0 ? 60.0 : 0.001 * seen_mm;
      bool is_met = false;
      for (int limb = 0; limb < body.limb_count(); ++limb) {
        const auto depth_m = DepthOn(body.limbs()[static_cast<std::size_t>(limb)].shape,
                                     kinematics.limb(limb), picture.camera.Ray(u, v));
        if (!depth_m || *depth_m >= nearest_m) continue;
        nearest_m = *depth_m;
        is_met = true;
      }
      if (!is_met) continue;
      const double noise_m =
          picture.camera.noise.Sigma_m(nearest_m) * static_cast<double>(random.Normal(pixel));
      seen_mm = cv::saturate_cast<std::uint16_t>(1000.0 * (nearest_m + noise_m));
      picture.owner.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(owner);
    }
  }
}

geometry::StereoCalibration CalibrationOf(const Picture& picture) {
  geometry::StereoCalibration calibration;
  calibration.camera = "STEREO";
  auto& lens = calibration.rectified;
  lens.camera = "STEREO";
  lens.width_px = picture.camera.width_px;
  lens.height_px = picture.camera.height_px;
  lens.focal_px = picture.camera.focal_px;
  lens.principal_point_px = picture.camera.centre_px;
  lens.is_calibrated = true;
  calibration.left = calibration.right = lens;
  calibration.depth_sigma_m_at_1m = picture.camera.noise.per_square_m;
  return calibration;
}

}  // namespace deixis::pose_fitter::test
