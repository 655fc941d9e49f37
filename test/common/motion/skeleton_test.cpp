#include "common/motion/skeleton.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace deixis::motion {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Kind = ChannelKind;

Skeleton Arm() {
  Joint root;
  root.name = "root";
  root.channels = {Kind::kXTranslation, Kind::kYTranslation, Kind::kZTranslation,
                   Kind::kZRotation,    Kind::kXRotation,    Kind::kYRotation};
  Joint elbow;
  elbow.name = "elbow";
  elbow.parent = 0;
  elbow.offset_m = {0.3, 0.1, -0.2};
  elbow.pre_rotation = AngleAxisd(0.7, Vector3d::UnitX());
  elbow.channels = {Kind::kZRotation};
  Joint wrist;
  wrist.name = "wrist";
  wrist.parent = 1;
  wrist.offset_m = {0.25, 0.0, 0.0};
  return {{root, elbow, wrist}};
}

Eigen::VectorXd Frame() {
  Eigen::VectorXd frame(7);
  frame << 1.0, 2.0, 3.0, 0.4, -0.5, 0.6, 0.8;
  return frame;
}

TEST(ForwardKinematics, AgreesWithProductsOfRotationsByHand) {
  const auto poses = ForwardKinematics(Arm(), Frame());
  const Matrix3d root = (AngleAxisd(0.4, Vector3d::UnitZ()) * AngleAxisd(-0.5, Vector3d::UnitX()) *
                         AngleAxisd(0.6, Vector3d::UnitY()))
                            .toRotationMatrix();
  // C M C^-1 is the same turn about the turned axis.
  const Vector3d axis(0.0, -std::sin(0.7), std::cos(0.7));
  const Matrix3d elbow = root * AngleAxisd(0.8, axis).toRotationMatrix();
  const Vector3d elbow_m = Vector3d(1.0, 2.0, 3.0) + root * Vector3d(0.3, 0.1, -0.2);
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_TRUE(poses[1].translation().isApprox(elbow_m, 1e-12));
  EXPECT_TRUE(poses[2].linear().isApprox(elbow, 1e-12));
  EXPECT_TRUE(poses[2].translation().isApprox(elbow_m + elbow * Vector3d(0.25, 0.0, 0.0), 1e-12));
}

TEST(ForwardKinematics, StandsAtRestAsTheRestRotationSays) {
  Skeleton arm = Arm();
  arm.joints[0].rest_rotation = AngleAxisd(0.9, Vector3d::UnitY());
  const Matrix3d rest = AngleAxisd(0.9, Vector3d::UnitY()).toRotationMatrix();
  const auto poses = ForwardKinematics(arm, Eigen::VectorXd::Zero(7));
  EXPECT_TRUE(poses[0].linear().isApprox(rest, 1e-12));
  EXPECT_TRUE(poses[2].translation().isApprox(rest * Vector3d(0.55, 0.1, -0.2), 1e-12));
  const Matrix3d turned = ForwardKinematics(Arm(), Frame())[0].linear();
  EXPECT_TRUE(ForwardKinematics(arm, Frame())[0].linear().isApprox(rest * turned, 1e-12));
}

TEST(ForwardKinematics, RefusesAFrameOfAnotherLength) {
  EXPECT_THROW(ForwardKinematics(Arm(), Frame().head(6)), std::logic_error);
}

TEST(ForwardKinematics, RefusesAChildBeforeItsParent) {
  Skeleton arm = Arm();
  arm.joints[1].parent = 2;
  EXPECT_THROW(ForwardKinematics(arm, Frame()), std::logic_error);
}

}  // namespace
}  // namespace deixis::motion
