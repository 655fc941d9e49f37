#include "common/body_model/joint_angles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/body_model/kinematics.h"
#include "test/common/body_model/body_samples.h"

namespace deixis::body_model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d InParent(const Kinematics& kinematics, int limb) {
  const int parent = kinematics.model().limbs()[static_cast<std::size_t>(limb)].parent;
  return kinematics.limb(parent).linear().transpose() * kinematics.limb(limb).linear();
}

TEST(JointAngles, AreThoseThatTheLimbWasTurnedBy) {
  std::mt19937 random(9);
  const BodyModel model("sample", ArmAndHead());
  Kinematics kinematics(model);
  for (int i = 0; i < 200; ++i) {
    const BodyPose pose = RandomPose(model, random);
    kinematics.Update(pose);
    for (int limb = 1; limb < model.limb_count(); ++limb) {
      const Limb& shape = model.limbs()[static_cast<std::size_t>(limb)];
      const auto count = static_cast<Eigen::Index>(shape.dofs.size());
      const auto expected = pose.angles_rad.segment(model.first_angle(limb), count);
      EXPECT_LE((JointAngles(shape, InParent(kinematics, limb)) - expected).norm(), 1e-9)
          << shape.name;
    }
  }
}

TEST(JointAngles, TurnABallJointExactlyByAnyRotation) {
  std::mt19937 random(10);
  const BodyModel model("sample", ArmAndHead());
  const Limb& upper_arm = model.limbs()[1];
  Kinematics kinematics(model);
  for (int i = 0; i < 200; ++i) {
    const Matrix3d wanted = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    BodyPose pose = RestPose(model);
    pose.angles_rad.head<3>() = JointAngles(upper_arm, wanted);
    kinematics.Update(pose);
    EXPECT_LE((InParent(kinematics, 1) - wanted).norm(), 1e-9);
  }
}

TEST(JointAngles, PointAHingeAsNearAsItCan) {
  const BodyModel model("sample", ArmAndHead());
  Limb hinge = model.limbs()[2];
  hinge.dofs.resize(1);
  const Matrix3d wanted = RotationFrom({0.0, 0.7, 0.0}) * RotationFrom({0.2, 0.0, 0.0});
  EXPECT_NEAR(JointAngles(hinge, wanted)[0], 0.7, 1e-9);
}

TEST(PointLimb, PointsALimbAnywhereWhateverItsParentDoes) {
  std::mt19937 random(11);
  const BodyModel model("sample", ArmAndHead());
  Kinematics kinematics(model);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    BodyPose pose = RandomPose(model, random);
    const Vector3d direction(normal(random), normal(random), normal(random));
    PointLimb(model, 1, direction, pose);
    kinematics.Update(pose);
    const Vector3d in_root =
        pose.frame_from_root.rotation.inverse() * kinematics.limb(1).linear().col(2);
    EXPECT_LE((in_root - direction.normalized()).norm(), 1e-9);
    EXPECT_NEAR(pose.angles_rad[2], 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace deixis::body_model
