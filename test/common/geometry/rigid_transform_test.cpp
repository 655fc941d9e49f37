#include "common/geometry/rigid_transform.h"

#include <gtest/gtest.h>

namespace deixis::geometry {
namespace {

RigidTransform Random(unsigned seed) {
  std::srand(seed);
  return {Eigen::Quaterniond::UnitRandom(), Eigen::Vector3d::Random()};
}

TEST(RigidTransform, ChainsAsItsMatricesDo) {
  const RigidTransform c_from_b = Random(1);
  const RigidTransform b_from_a = Random(2);
  const Eigen::Vector3d point_m(0.3, -1.2, 2.5);
  EXPECT_TRUE(((c_from_b * b_from_a) * point_m).isApprox(c_from_b * (b_from_a * point_m), 1e-12));
}

TEST(RigidTransform, TimesItsInverseMovesNothing) {
  const RigidTransform b_from_a = Random(3);
  const Eigen::Vector3d point_m(-0.7, 0.1, 4.0);
  EXPECT_TRUE((Inverse(b_from_a) * (b_from_a * point_m)).isApprox(point_m, 1e-12));
}

TEST(RigidTransform, TurnsXIntoYByAQuarterAboutZ) {
  const RigidTransform b_from_a{
      Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ())), {1.0, 0.0, 0.0}};
  EXPECT_TRUE(
      (b_from_a * Eigen::Vector3d(1.0, 0.0, 0.0)).isApprox(Eigen::Vector3d(1, 1, 0), 1e-12));
}

}  // namespace
}  // namespace deixis::geometry
