#include "services/pose_fitter/core/limb_icp/rigid_motion.h"

#include <gtest/gtest.h>

#include <random>

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector3d;

Eigen::Isometry3d SomeMotion() {
  Eigen::Isometry3d motion(Eigen::AngleAxisd(0.7, Vector3d(1.0, -2.0, 0.5).normalized()));
  motion.translation() = Vector3d(0.1, -0.3, 2.0);
  return motion;
}

Vector3d Random(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random);
  return {x, y, normal(random)};
}

TEST(RigidMotion, IsExactOnExactPairs) {
  std::mt19937 random(1);
  PairSums sums;
  for (int i = 0; i < 20; ++i) {
    const Vector3d from = Random(random);
    sums.Add(from, SomeMotion() * from);
  }
  EXPECT_TRUE(RigidMotion(sums).isApprox(SomeMotion(), 1e-9));
}

TEST(RigidMotion, IsNearInNoise) {
  std::mt19937 random(2);
  PairSums sums;
  for (int i = 0; i < 5000; ++i) {
    const Vector3d from = Random(random);
    sums.Add(from, SomeMotion() * from + 0.05 * Random(random));
  }
  EXPECT_TRUE(RigidMotion(sums).isApprox(SomeMotion(), 5e-3));
}

TEST(RigidMotion, IsNoReflection) {
  std::mt19937 random(3);
  PairSums sums;
  for (int i = 0; i < 20; ++i) {
    const Vector3d from = Random(random);
    sums.Add(from, Vector3d(-from.x(), from.y(), from.z()));
  }
  EXPECT_NEAR(RigidMotion(sums).linear().determinant(), 1.0, 1e-9);
}

TEST(RigidMotion, OfPointsOnALineIsATranslation) {
  PairSums sums;
  for (int i = 0; i < 20; ++i) sums.Add({0.0, 0.0, 0.1 * i}, {0.5, 0.0, 0.1 * i});
  const Eigen::Isometry3d motion = RigidMotion(sums);
  EXPECT_TRUE(motion.linear().isIdentity(1e-9));
  EXPECT_TRUE(motion.translation().isApprox(Vector3d(0.5, 0.0, 0.0), 1e-9));
}

TEST(RigidMotion, OfNoPointsIsNone) {
  EXPECT_TRUE(RigidMotion({}).isApprox(Eigen::Isometry3d::Identity()));
}

}  // namespace
}  // namespace deixis::pose_fitter
