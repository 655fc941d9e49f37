#include "services/pose_fitter/core/bodies/limb_poses.h"

#include <gtest/gtest.h>

#include "common/body_model/kinematics.h"
#include "test/services/pose_fitter/synthetic_body.h"

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector3d;

/// Somebody before the camera who need not face it.
class LimbPosesTest : public ::testing::TestWithParam<double> {
 protected:
  LimbPosesTest() {
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
  ChainLimbs arm_ = *LimbsOf(model_, Chain::kRightArm), leg_ = *LimbsOf(model_, Chain::kLeftLeg);
  Vector3d up_ = -Vector3d::UnitY();
  Eigen::Matrix3d trunk_;
  Vector3d shoulder_m_;
};

TEST_P(LimbPosesTest, ReachAPlaceWithTheHand) {
  for (const Vector3d& in_trunk :
       {Vector3d(0.4, 0.0, 0.1), Vector3d(0.2, -0.2, -0.3), Vector3d(0.25, 0.1, 0.3)}) {
    const Vector3d place_m = shoulder_m_ + trunk_ * in_trunk;
    double nearest_m = 1e9;
    for (const auto& pose : ReachingPoses(model_, arm_, pose_, place_m)) {
      nearest_m = std::min(nearest_m, (Hand_m(pose) - place_m).norm());
    }
    EXPECT_LT(nearest_m, 0.05) << in_trunk.transpose();
  }
}

TEST_P(LimbPosesTest, ReachAsFarAsTheArmIsLong) {
  const Vector3d place_m = shoulder_m_ + trunk_ * Vector3d(3.0, 0.0, 0.0);
  double farthest_m = 0.0;
  for (const auto& pose : ReachingPoses(model_, arm_, pose_, place_m)) {
    farthest_m = std::max(farthest_m, (Hand_m(pose) - shoulder_m_).norm());
  }
  EXPECT_GT(farthest_m, 0.5);
  EXPECT_LT(farthest_m, 0.8);
}

TEST_P(LimbPosesTest, HoldTheArmWhereItHangsAndWhereItPointsForward) {
  bool hangs = false, forward = false;
  for (const auto& pose : UsualPoses(model_, arm_, pose_, up_)) {
    const Vector3d in_trunk = trunk_.transpose() * (Hand_m(pose) - shoulder_m_);
    hangs = hangs || in_trunk.z() < -0.5;
    forward = forward || in_trunk.x() > 0.45;
  }
  EXPECT_TRUE(hangs);
  EXPECT_TRUE(forward);
}

TEST_P(LimbPosesTest, PutTheElbowWhereItIsSeen) {
  const Vector3d elbow_m = shoulder_m_ + 0.26 * (trunk_ * Vector3d(0.3, -0.9, 0.1)).normalized();
  const auto poses = ElbowPoses(model_, arm_, pose_, elbow_m);
  ASSERT_FALSE(poses.empty());
  for (const auto& pose : poses) {
    kinematics_.Update(pose);
    EXPECT_LT((kinematics_.distal_m(*model_.Find("right_upper_arm")) - elbow_m).norm(), 0.04);
  }
}

TEST_P(LimbPosesTest, LeaveTheRestOfTheBodyAlone) {
  for (const auto& pose : UsualPoses(model_, arm_, pose_, up_)) {
    kinematics_.Update(pose_);
    const Vector3d left_m = kinematics_.distal_m(*model_.Find("left_hand"));
    kinematics_.Update(pose);
    EXPECT_LT((kinematics_.distal_m(*model_.Find("left_hand")) - left_m).norm(), 1e-9);
  }
}

TEST_P(LimbPosesTest, StandALegOnTheFloorWhateverTheTrunkDoes) {
  const Eigen::AngleAxisd bow(1.2, pose_.frame_from_root.rotation * Vector3d::UnitY());
  pose_.frame_from_root.rotation = bow * pose_.frame_from_root.rotation;
  double lowest_m = 1e9, nearest_m = 1e9;
  for (const auto& pose : UsualPoses(model_, leg_, pose_, up_)) {
    kinematics_.Update(pose);
    const Vector3d hip_m = kinematics_.proximal_m(leg_.upper);
    const Vector3d ankle_m = kinematics_.distal_m(leg_.lower);
    const Vector3d below_m = hip_m - (leg_.upper_m + leg_.lower_m) * up_;
    lowest_m = std::min(lowest_m, up_.dot(ankle_m - hip_m));
    nearest_m = std::min(nearest_m, (ankle_m - below_m).norm());
  }
  EXPECT_LT(lowest_m, -0.7);
  EXPECT_LT(nearest_m, 0.2);
}

TEST_P(LimbPosesTest, BendKneesBackward) {
  kinematics_.Update(pose_);
  const Vector3d hip_m = kinematics_.proximal_m(leg_.upper);
  const Vector3d front = pose_.frame_from_root.rotation * Vector3d::UnitX();
  const Vector3d ankle_m = hip_m - 0.6 * up_;
  double nearest_m = 1e9;
  for (const auto& pose : ReachingPoses(model_, leg_, pose_, ankle_m)) {
    kinematics_.Update(pose);
    const double off_m = (kinematics_.distal_m(leg_.lower) - ankle_m).norm();
    if (off_m > 0.06) continue;
    nearest_m = std::min(nearest_m, off_m);
    EXPECT_GT(front.dot(kinematics_.distal_m(leg_.upper) - 0.5 * (hip_m + ankle_m)), -0.1);
  }
  EXPECT_LT(nearest_m, 0.06);
}

INSTANTIATE_TEST_SUITE_P(Turned, LimbPosesTest, ::testing::Values(0.0, 0.8, 2.5));

}  // namespace
}  // namespace deixis::pose_fitter
