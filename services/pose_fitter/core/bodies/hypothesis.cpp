#include "services/pose_fitter/core/bodies/hypothesis.h"

#include <Eigen/Geometry>

#include "common/body_model/kinematics.h"

namespace deixis::pose_fitter {

body_model::BodyPose Predict(const Hypothesis& hypothesis, double seconds, double share) {
  body_model::BodyPose pose = hypothesis.pose;
  const double ahead_s = share * seconds;
  pose.frame_from_root.translation_m += ahead_s * hypothesis.velocity_m_per_s;
  const Eigen::Quaterniond turn(body_model::RotationFrom(ahead_s * hypothesis.turn_rate_rad_per_s));
  pose.frame_from_root.rotation = (turn * pose.frame_from_root.rotation).normalized();
  pose.angles_rad += ahead_s * hypothesis.rates_rad_per_s;
  return pose;
}

bool IsTurnedAbout(const body_model::BodyPose& pose, const body_model::BodyPose& other) {
  const auto forward = [](const body_model::BodyPose& of) {
    return of.frame_from_root.rotation * Eigen::Vector3d::UnitX();
  };
  return forward(pose).dot(forward(other)) < 0.0;
}

void Move(const body_model::BodyPose& pose, double seconds, Hypothesis& hypothesis) {
  const body_model::BodyPose& before = hypothesis.pose;
  hypothesis.velocity_m_per_s =
      (pose.frame_from_root.translation_m - before.frame_from_root.translation_m) / seconds;
  const Eigen::AngleAxisd turn(pose.frame_from_root.rotation *
                               before.frame_from_root.rotation.conjugate());
  hypothesis.turn_rate_rad_per_s = turn.angle() * turn.axis() / seconds;
  hypothesis.rates_rad_per_s = (pose.angles_rad - before.angles_rad) / seconds;
  hypothesis.pose = pose;
  hypothesis.age_s += seconds;
}

}  // namespace deixis::pose_fitter
