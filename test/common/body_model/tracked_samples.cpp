#include "test/common/body_model/tracked_samples.h"

#include "test/common/body_model/body_samples.h"

namespace deixis::body_model {
namespace {

Eigen::MatrixXd Covariance(int angle_count) {
  const Eigen::Index size = 6 + angle_count;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(size, size);
  for (Eigen::Index row = 0; row < size; ++row) {
    for (Eigen::Index column = 0; column < row; ++column) {
      covariance(row, column) = covariance(column, row) =
          static_cast<double>(row * size + column) / (1 << 20);
    }
  }
  return covariance;
}

}  // namespace

PersonModel PersonOf(BodyModel body) {
  PersonModel person{kSampleTime, std::move(body)};
  person.person_id = 3;
  person.identity = "badge 17";
  person.sex = anthropometry::Sex::kMale;
  person.female_probability = 0.25;
  person.stature_m = 1.8;
  person.stature_variance_m2 = 0.0025;
  person.is_frozen = true;
  return person;
}

TrackedBody BodyOf(const BodyModel& model, std::mt19937& random) {
  TrackedBody body;
  body.person_id = 3;
  body.identity = "badge 17";
  body.state = BodyState::kTracked;
  body.pose = RandomPose(model, random);
  body.pose.frame_from_root.rotation.normalize();
  body.root_velocity_m_per_s = {0.1, 0.2, 0.3};
  body.root_rate_rad_per_s = {-0.1, -0.2, -0.3};
  body.rates_rad_per_s = Eigen::VectorXd::LinSpaced(model.angle_count(), -1.0, 2.0);
  body.covariance = Covariance(model.angle_count());
  Kinematics kinematics(model);
  PlaceLimbs(kinematics, body);
  body.limbs[0].state = LimbState::kMeasured;
  body.limbs[0].residual_m = 0.012;
  body.limbs[0].inlier_count = 345;
  return body;
}

BodyPoses PosesOf(const TrackedBody& body) {
  return {kSampleTime, "STEREO", "camera", "pose_fitter", Floor{{0.0, -0.8, -0.6}, 1.4}, {body}};
}

}  // namespace deixis::body_model
