#include "test/services/pose_fitter/shape/seen_person.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;
using body_model::BodyPose;
using body_model::Kinematics;
using Eigen::Vector3d;

constexpr double kDistance_m = 2.3;

class Watcher {
 public:
  Watcher(const BodyModel& truth, double noise_m, unsigned seed)
      : truth_(truth), kinematics_(truth), noise_m_(noise_m), random_(seed) {}

  BodyPose Pose() {
    BodyPose pose = body_model::Standing(truth_);
    int index = 0;
    for (const body_model::Limb& limb : truth_.limbs()) {
      for (const body_model::DegreeOfFreedom& dof : limb.dofs) {
        const double reach = 0.35 * (dof.angle_max_rad - dof.angle_min_rad);
        double& angle = pose.angles_rad[index++];
        angle = std::clamp(angle + Uniform(-reach, reach), dof.angle_min_rad, dof.angle_max_rad);
      }
    }
    // Facing the camera, more or less: x forward is -z, z up is -y.
    Eigen::Matrix3d axes;
    axes << 0, 1, 0, 0, 0, -1, -1, 0, 0;
    const Eigen::AngleAxisd turn(Uniform(-0.9, 0.9), Vector3d::UnitY());
    pose.frame_from_root = {Eigen::Quaterniond(turn * axes),
                            {Uniform(-0.3, 0.3), 0.1, kDistance_m + Uniform(-0.3, 0.3)}};
    return pose;
  }

  BodyPose Rough(BodyPose pose) {
    for (double& angle : pose.angles_rad) angle += Normal(0.06);
    pose.frame_from_root.translation_m += Vector3d(Normal(0.02), Normal(0.02), Normal(0.02));
    return pose;
  }

  std::vector<ShapePoint> Points(const BodyPose& pose, int count) {
    kinematics_.Update(pose);
    std::vector<ShapePoint> points;
    while (static_cast<int>(points.size()) < count) Add(points);
    return points;
  }

 private:
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double Normal(double sigma) { return std::normal_distribution<double>(0.0, sigma)(random_); }

  void Add(std::vector<ShapePoint>& points) {
    const int limb = std::uniform_int_distribution<int>(0, truth_.limb_count() - 1)(random_);
    const auto& shape = truth_.limbs()[static_cast<std::size_t>(limb)].shape;
    const double phi_rad = Uniform(-M_PI, M_PI), s = Uniform(0.0, 1.0);
    const Eigen::Isometry3d& place = kinematics_.limb(limb);
    const Vector3d point_m = place * geometry::SidePoint(shape, phi_rad, s);
    const Vector3d normal = place.linear() * geometry::SideNormal(shape, phi_rad, s);
    if (normal.dot(point_m.normalized()) > -0.1 || IsWithinOther(limb, point_m)) return;
    points.push_back({point_m + Normal(noise_m_) * point_m.normalized(), noise_m_, limb});
  }
  bool IsWithinOther(int limb, const Vector3d& point_m) const {
    for (int other = 0; other < truth_.limb_count(); ++other) {
      const auto& shape = truth_.limbs()[static_cast<std::size_t>(other)].shape;
      if (other != limb && geometry::IsInside(shape, kinematics_.limb(other).inverse() * point_m)) {
        return true;
      }
    }
    return false;
  }

  const BodyModel& truth_;
  Kinematics kinematics_;
  double noise_m_;
  std::mt19937 random_;
};

}  // namespace

ShapeParameters ClothedPerson(double stature_m, double stature_sigma_m) {
  const std::string config = DEIXIS_SOURCE_DIR "/config/";
  const auto plan = body_model::LoadBodyPlan(config + "body_models/clothed_body.yaml");
  const auto estimate = anthropometry::EstimatePerson(
      anthropometry::Populations::Load(config + "kinematics/population.yaml"),
      {{"kph", stature_m, stature_sigma_m * stature_sigma_m}});
  return {body_model::Build(plan, estimate.Sizes_m()), plan, estimate};
}

Scene Watch(const BodyModel& truth, int frame_count, int point_count, double noise_m,
            unsigned seed) {
  Watcher watcher(truth, noise_m, seed);
  Scene scene;
  for (int i = 0; i < frame_count; ++i) {
    const BodyPose pose = watcher.Pose();
    scene.frames.push_back({pose, watcher.Points(pose, point_count)});
    scene.rough_poses.push_back(watcher.Rough(pose));
  }
  return scene;
}

}  // namespace deixis::pose_fitter
