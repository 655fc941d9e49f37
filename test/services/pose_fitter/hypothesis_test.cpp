#include "services/pose_fitter/core/bodies/hypothesis.h"

#include <gtest/gtest.h>

#include "common/body_model/kinematics.h"

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector3d;

constexpr double kSeconds = 0.1;
const Vector3d kTurn_rad(0.0, 0.2, 0.0);

/// Somebody with three angles, who was at the origin and is now a bit further.
Hypothesis Moved() {
  Hypothesis hypothesis;
  hypothesis.pose.angles_rad = Vector3d(0.1, 0.2, 0.3);
  body_model::BodyPose pose = hypothesis.pose;
  pose.frame_from_root.translation_m = {0.05, 0.0, -0.02};
  pose.frame_from_root.rotation = Eigen::Quaterniond(body_model::RotationFrom(kTurn_rad));
  pose.angles_rad += Vector3d(0.01, 0.0, -0.02);
  Move(pose, kSeconds, hypothesis);
  return hypothesis;
}

TEST(Hypothesis, TellsItsMotionFromTwoPoses) {
  const Hypothesis hypothesis = Moved();
  EXPECT_LT((hypothesis.velocity_m_per_s - Vector3d(0.5, 0.0, -0.2)).norm(), 1e-12);
  EXPECT_LT((hypothesis.turn_rate_rad_per_s - kTurn_rad / kSeconds).norm(), 1e-9);
  EXPECT_LT((hypothesis.rates_rad_per_s - Vector3d(0.1, 0.0, -0.2)).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(hypothesis.age_s, kSeconds);
}

TEST(Hypothesis, GoesOnAsItWent) {
  const auto ahead = Predict(Moved(), kSeconds, 1.0);
  EXPECT_LT((ahead.frame_from_root.translation_m - Vector3d(0.1, 0.0, -0.04)).norm(), 1e-12);
  const Eigen::Quaterniond twice(body_model::RotationFrom(2.0 * kTurn_rad));
  EXPECT_LT(ahead.frame_from_root.rotation.angularDistance(twice), 1e-7);
  EXPECT_LT((ahead.angles_rad - Vector3d(0.12, 0.2, 0.26)).norm(), 1e-12);
}

TEST(Hypothesis, StaysWithoutAShareOfItsMotion) {
  const Hypothesis hypothesis = Moved();
  const auto ahead = Predict(hypothesis, kSeconds, 0.0);
  EXPECT_EQ(ahead.frame_from_root.translation_m, hypothesis.pose.frame_from_root.translation_m);
  EXPECT_EQ(ahead.angles_rad, hypothesis.pose.angles_rad);
}

TEST(Hypothesis, TakesTheShorterWayRound) {
  Hypothesis hypothesis;
  hypothesis.pose.angles_rad = Vector3d::Zero();
  body_model::BodyPose pose = hypothesis.pose;
  pose.frame_from_root.rotation.coeffs() *= -1.0;  // The same orientation.
  Move(pose, kSeconds, hypothesis);
  EXPECT_LT(hypothesis.turn_rate_rad_per_s.norm(), 1e-9);
}

}  // namespace
}  // namespace deixis::pose_fitter
