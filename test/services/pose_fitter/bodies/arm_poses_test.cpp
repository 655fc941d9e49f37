#include "services/pose_fitter/core/bodies/arm_poses.h"

#include <gtest/gtest.h>

#include "common/body_model/kinematics.h"
#include "test/services/pose_fitter/synthetic_body.h"

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector3d;

/// Somebody before the camera who need not face it.
class ArmPosesTest : public ::testing::TestWithParam<double> {
 protected:
  ArmPosesTest() {
    const Eigen::AngleAxisd turn(GetParam(), Vector3d::UnitY());
    pose_.frame_from_root.rotation = turn * pose_.frame_from_root.rotation;
    kinematics_.Update(pose_);
    trunk_ = kinematics_.limb(*model_.Find("chest")).linear();
    shoulder_m_ = kinematics_.proximal_m(*model_.Find("right_upper_arm"));
  }
  Vector3d Hand_m(const body_model::BodyPose& pose) {
    const int hand = *model_.Find("right_hand");
    kinematics_.Update(pose);
    return 0.65 * kinematics_.proximal_m(hand) + 0.35 * kinematics_.distal_m(hand);
  }

  body_model::BodyModel model_ = test::BodyOf("clothed_body");
  body_model::BodyPose pose_ = test::Gesturing(model_);
  body_model::Kinematics kinematics_{model_};
  Eigen::Matrix3d trunk_;
  Vector3d shoulder_m_;
};

TEST_P(ArmPosesTest, ReachAPlaceWithTheHand) {
  for (const Vector3d& in_trunk :
       {Vector3d(0.4, 0.0, 0.1), Vector3d(0.2, -0.2, -0.3), Vector3d(0.25, 0.1, 0.3)}) {
    const Vector3d place_m = shoulder_m_ + trunk_ * in_trunk;
    double nearest_m = 1e9;
    for (const auto& pose : ReachingPoses(model_, pose_, ArmSide::kRight, place_m)) {
      nearest_m = std::min(nearest_m, (Hand_m(pose) - place_m).norm());
    }
    EXPECT_LT(nearest_m, 0.05) << in_trunk.transpose();
  }
}

TEST_P(ArmPosesTest, ReachAsFarAsTheArmIsLong) {
  const Vector3d place_m = shoulder_m_ + trunk_ * Vector3d(3.0, 0.0, 0.0);
  double farthest_m = 0.0;
  for (const auto& pose : ReachingPoses(model_, pose_, ArmSide::kRight, place_m)) {
    farthest_m = std::max(farthest_m, (Hand_m(pose) - shoulder_m_).norm());
  }
  EXPECT_GT(farthest_m, 0.5);
  EXPECT_LT(farthest_m, 0.8);
}

TEST_P(ArmPosesTest, HoldTheArmWhereItHangsAndWhereItPointsForward) {
  bool hangs = false, forward = false;
  for (const auto& pose : ArmPoses(model_, pose_, ArmSide::kRight)) {
    const Vector3d in_trunk = trunk_.transpose() * (Hand_m(pose) - shoulder_m_);
    hangs = hangs || in_trunk.z() < -0.5;
    forward = forward || in_trunk.x() > 0.45;
  }
  EXPECT_TRUE(hangs);
  EXPECT_TRUE(forward);
}

TEST_P(ArmPosesTest, PutTheElbowWhereItIsSeen) {
  const Vector3d elbow_m = shoulder_m_ + 0.26 * (trunk_ * Vector3d(0.3, -0.9, 0.1)).normalized();
  const auto poses = ElbowPoses(model_, pose_, ArmSide::kRight, elbow_m);
  ASSERT_FALSE(poses.empty());
  for (const auto& pose : poses) {
    kinematics_.Update(pose);
    EXPECT_LT((kinematics_.distal_m(*model_.Find("right_upper_arm")) - elbow_m).norm(), 0.04);
  }
}

TEST_P(ArmPosesTest, LeaveTheRestOfTheBodyAlone) {
  for (const auto& pose : ArmPoses(model_, pose_, ArmSide::kRight)) {
    kinematics_.Update(pose_);
    const Vector3d left_m = kinematics_.distal_m(*model_.Find("left_hand"));
    kinematics_.Update(pose);
    EXPECT_LT((kinematics_.distal_m(*model_.Find("left_hand")) - left_m).norm(), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Turned, ArmPosesTest, ::testing::Values(0.0, 0.8, 2.5));

TEST(ArmPoses, AreNoneForAnArmThatTheModelLacks) {
  const auto model = test::BodyOf("right_arm");
  const auto pose = body_model::RestPose(model);
  EXPECT_TRUE(ArmPoses(model, pose, ArmSide::kLeft).empty());
  EXPECT_TRUE(ReachingPoses(model, pose, ArmSide::kLeft, {0.0, 0.0, 2.0}).empty());
  EXPECT_TRUE(ElbowPoses(model, pose, ArmSide::kLeft, {0.0, 0.0, 2.0}).empty());
}

}  // namespace
}  // namespace deixis::pose_fitter
