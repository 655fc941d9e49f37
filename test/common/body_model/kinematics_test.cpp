#include "common/body_model/kinematics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/common/body_model/body_samples.h"

namespace deixis::body_model {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

BodyModel Sample() { return {"sample", ArmAndHead()}; }

Vector3d AnyVector(std::mt19937& random, double length) {
  std::normal_distribution<double> normal;
  return length * Vector3d(normal(random), normal(random), normal(random)).normalized();
}

TEST(RotationFrom, IsThatOfAngleAndAxis) {
  std::mt19937 random(3);
  for (const double angle : {0.0, 1e-9, 1e-5, 1e-4, 0.3, 2.0, M_PI, 5.0}) {
    const Vector3d axis = AnyVector(random, 1.0);
    const Matrix3d expected = AngleAxisd(angle, axis).toRotationMatrix();
    EXPECT_LE((RotationFrom(angle * axis) - expected).norm(), 1e-14) << angle;
  }
}

TEST(LeftJacobian, IsTheDerivativeOfTheRotation) {
  std::mt19937 random(4);
  for (const double angle : {0.0, 1e-5, 1e-4, 0.3, 2.0, M_PI, 4.0}) {
    const Vector3d v = AnyVector(random, angle), dv = AnyVector(random, 1e-6);
    const AngleAxisd turn(RotationFrom(v + dv) * RotationFrom(v - dv).transpose());
    EXPECT_LE((turn.angle() * turn.axis() - 2.0 * LeftJacobian(v) * dv).norm(), 1e-11) << angle;
  }
}

TEST(Kinematics, PutsLimbsEndToEndWhenAllAnglesAreZero) {
  std::vector<Limb> limbs = ArmAndHead();
  limbs[1].rest_in_parent = {};
  limbs[1].rest_in_parent.translation_m = {0.0, 0.0, 0.3};
  const BodyModel model("straight", limbs);
  Kinematics kinematics(model);
  kinematics.Update(RestPose(model));
  EXPECT_LE((kinematics.distal_m(3) - Vector3d(0, 0, 1.2)).norm(), 1e-12);
}

TEST(Kinematics, BendsAnElbowAsTheHandRuleSays) {
  const BodyModel model = Sample();
  BodyPose pose = RestPose(model);
  pose.angles_rad[3] = M_PI / 2;  // About y: z turns to x.
  Kinematics kinematics(model);
  kinematics.Update(pose);
  const Matrix3d upper = kinematics.limb(1).linear(), lower = kinematics.limb(2).linear();
  EXPECT_LE((lower.col(2) - upper.col(0)).norm(), 1e-12);
}

TEST(Kinematics, TurnsBySwingThenTwist) {
  const BodyModel model = Sample();
  BodyPose pose = RestPose(model);
  pose.angles_rad.head<3>() << 0.7, -0.4, 0.9;
  Kinematics kinematics(model);
  kinematics.Update(pose);
  const Matrix3d expected = model.limbs()[1].rest_in_parent.rotation.toRotationMatrix() *
                            RotationFrom({0.7, -0.4, 0.0}) * RotationFrom({0.0, 0.0, -0.9});
  EXPECT_LE((kinematics.limb(1).linear() - expected).norm(), 1e-12);
}

TEST(Kinematics, KeepsJointsTogetherAndRotationsPure) {
  std::mt19937 random(5);
  const BodyModel model = Sample();
  Kinematics kinematics(model);
  for (int i = 0; i < 100; ++i) {
    kinematics.Update(RandomPose(model, random));
    for (int limb = 0; limb < model.limb_count(); ++limb) {
      EXPECT_TRUE(kinematics.limb(limb).linear().isUnitary(1e-12));
    }
    EXPECT_LE((kinematics.proximal_m(2) - kinematics.distal_m(1)).norm(), 1e-12);
  }
}

TEST(Kinematics, RefusesAnotherModelsAngles) {
  const BodyModel model = Sample();
  Kinematics kinematics(model);
  EXPECT_THROW(kinematics.Update(BodyPose{}), std::logic_error);
}

TEST(PointJacobian, IsTheDerivativeOfForwardKinematics) {
  std::mt19937 random(6);
  const BodyModel model = Sample();
  for (int i = 0; i < 50; ++i) ExpectDerivatives(model, RandomPose(model, random));
}

TEST(PointJacobian, HoldsAtRestAndAtHalfATurnOfAbduction) {
  std::vector<Limb> limbs = ArmAndHead();
  limbs[1].rest_in_parent.rotation =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), -Vector3d::UnitZ());
  limbs[1].dofs[0].angle_max_rad = M_PI;
  const BodyModel model("raised", limbs);
  BodyPose pose = RestPose(model);
  ExpectDerivatives(model, pose);
  pose.angles_rad[0] = M_PI;
  ExpectDerivatives(model, pose);
}

}  // namespace
}  // namespace deixis::body_model
