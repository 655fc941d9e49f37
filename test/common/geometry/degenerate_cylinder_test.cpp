#include "common/geometry/degenerate_cylinder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "test/common/geometry/cylinder_samples.h"

namespace deixis::geometry {
namespace {

using Eigen::Vector3d;

const DegenerateCylinder kPlain{0.05, 0.04, 0.03, 0.02, 0.3};

void ExpectNear(const Vector3d& a, const Vector3d& b, double tolerance) {
  EXPECT_LE((a - b).norm(), tolerance) << a.transpose() << " against " << b.transpose();
}

TEST(DegenerateCylinder, SideRunsFromOneEllipseToTheOther) {
  ExpectNear(SidePoint(kPlain, 0.0, 0.0), {0.05, 0, 0}, 1e-15);
  ExpectNear(SidePoint(kPlain, M_PI / 2, 1.0), {0, 0.02, 0.3}, 1e-15);
  ExpectNear(SidePoint(kPlain, M_PI, 0.5), {-0.04, 0, 0.15}, 1e-15);
}

TEST(DegenerateCylinder, SideNormalIsPerpendicularToItsTangentsAndPointsOutward) {
  for (const DegenerateCylinder& cylinder : RandomCylinders(50)) {
    for (double phi = 0.0; phi < 6.28; phi += 0.37) {
      for (const double s : {0.0, 0.3, 1.0}) {
        const Vector3d normal = SideNormal(cylinder, phi, s);
        const double h = 1e-6;
        const Vector3d around = SidePoint(cylinder, phi + h, s) - SidePoint(cylinder, phi - h, s);
        const Vector3d along = SidePoint(cylinder, phi, s + h) - SidePoint(cylinder, phi, s - h);
        EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
        EXPECT_NEAR(normal.dot(around.normalized()), 0.0, 1e-6);
        EXPECT_NEAR(normal.dot(along.normalized()), 0.0, 1e-6);
        EXPECT_GT(normal.head<2>().dot(Eigen::Vector2d(std::cos(phi) / cylinder.a0_m,
                                                       std::sin(phi) / cylinder.b0_m)),
                  0.0);
      }
    }
  }
}

// The special cases of the source, each with an answer that is known without a search.
TEST(FindClosest, BesideAStraightRoundCylinder) {
  const DegenerateCylinder round{0.1, 0.1, 0.1, 0.1, 0.5};
  const ClosestPoint closest = FindClosest(round, {0.3, 0.4, 0.2});
  ExpectNear(closest.point_m, {0.06, 0.08, 0.2}, 1e-12);
  ExpectNear(closest.normal, {0.6, 0.8, 0.0}, 1e-12);
  EXPECT_NEAR(closest.signed_distance_m, 0.4, 1e-12);
  EXPECT_EQ(closest.part, CylinderPart::kSide);
}

TEST(FindClosest, BesideAConeIsPerpendicularToItsSlant) {
  const DegenerateCylinder cone{0.2, 0.2, 0.1, 0.1, 0.1};  // Slant of 45 degrees.
  const ClosestPoint closest = FindClosest(cone, {0.25, 0.0, 0.15});
  ExpectNear(closest.point_m, {0.15, 0.0, 0.05}, 1e-12);
  EXPECT_NEAR(closest.signed_distance_m, std::sqrt(0.02), 1e-12);
}

TEST(FindClosest, OverEitherDisc) {
  const ClosestPoint below = FindClosest(kPlain, {0.01, -0.02, -0.07});
  ExpectNear(below.point_m, {0.01, -0.02, 0.0}, 1e-15);
  ExpectNear(below.normal, {0, 0, -1}, 1e-15);
  EXPECT_NEAR(below.signed_distance_m, 0.07, 1e-15);
  EXPECT_EQ(below.part, CylinderPart::kProximalDisc);
  const ClosestPoint above = FindClosest(kPlain, {0.01, -0.01, 0.35});
  ExpectNear(above.point_m, {0.01, -0.01, 0.3}, 1e-15);
  EXPECT_NEAR(above.signed_distance_m, 0.05, 1e-15);
  EXPECT_EQ(above.part, CylinderPart::kDistalDisc);
}

TEST(FindClosest, BeyondAnEndAndBesideItIsTheEdge) {
  const DegenerateCylinder round{0.1, 0.1, 0.1, 0.1, 0.5};
  const ClosestPoint closest = FindClosest(round, {0.13, 0.0, 0.54});
  ExpectNear(closest.point_m, {0.1, 0.0, 0.5}, 1e-12);
  ExpectNear(closest.normal, {0.6, 0.0, 0.8}, 1e-9);
  EXPECT_NEAR(closest.signed_distance_m, 0.05, 1e-12);
}

TEST(FindClosest, InsideIsNegativeAndTakesTheNearestOfSideAndDiscs) {
  const DegenerateCylinder round{0.1, 0.1, 0.1, 0.1, 0.5};
  const ClosestPoint side = FindClosest(round, {0.06, 0.0, 0.25});
  EXPECT_NEAR(side.signed_distance_m, -0.04, 1e-12);
  ExpectNear(side.normal, {1, 0, 0}, 1e-9);
  const ClosestPoint disc = FindClosest(round, {0.01, 0.0, 0.49});
  EXPECT_NEAR(disc.signed_distance_m, -0.01, 1e-12);
  ExpectNear(disc.normal, {0, 0, 1}, 1e-9);
  EXPECT_EQ(disc.part, CylinderPart::kDistalDisc);
}

TEST(FindClosest, OnTheAxisIsTheShorterSemiAxisAway) {
  const DegenerateCylinder straight{0.05, 0.04, 0.05, 0.04, 0.3};
  const ClosestPoint closest = FindClosest(straight, {0.0, 0.0, 0.15});
  EXPECT_NEAR(closest.signed_distance_m, -0.04, 1e-12);
  EXPECT_NEAR(std::abs(closest.point_m.y()), 0.04, 1e-12);
  EXPECT_EQ(closest.point_m, FindClosest(straight, {0.0, 0.0, 0.15}).point_m);
}

TEST(FindClosest, OfARoundOneOnItsAxisIsItsRadiusAway) {
  const DegenerateCylinder round{0.1, 0.1, 0.1, 0.1, 0.5};
  const ClosestPoint closest = FindClosest(round, {0.0, 0.0, 0.25});
  EXPECT_NEAR(closest.signed_distance_m, -0.1, 1e-12);
  EXPECT_NEAR(closest.normal.norm(), 1.0, 1e-9);
}

TEST(FindClosest, FollowsEllipsesBesideTheBone) {
  DegenerateCylinder moved = kPlain;
  moved.centre0_m = moved.centre1_m = {0.02, -0.03};
  for (const Vector3d& point : RandomPoints(kPlain, 200)) {
    const ClosestPoint plain = FindClosest(kPlain, point);
    const ClosestPoint there = FindClosest(moved, point + Vector3d(0.02, -0.03, 0.0));
    EXPECT_NEAR(plain.signed_distance_m, there.signed_distance_m, 1e-12);
    ExpectNear(plain.point_m + Vector3d(0.02, -0.03, 0.0), there.point_m, 1e-7);
  }
}

TEST(FindClosest, OfASurfacePointIsThatPoint) {
  for (const DegenerateCylinder& cylinder : RandomCylinders(100)) {
    for (const double phi : {0.1, 1.7, 3.0, 5.5}) {
      const Vector3d point = SidePoint(cylinder, phi, 0.4);
      const ClosestPoint closest = FindClosest(cylinder, point);
      EXPECT_NEAR(closest.signed_distance_m, 0.0, 1e-12);
      ExpectNear(closest.point_m, point, 1e-7);
      EXPECT_GT(closest.normal.dot(SideNormal(cylinder, phi, 0.4)), 0.999);
    }
  }
}

// No point of a dense sampling is nearer, and one of them is nearly as near.
TEST(FindClosest, AgreesWithDenseSampling) {
  for (const DegenerateCylinder& cylinder : RandomCylinders(40)) {
    const std::vector<Vector3d> surface = DenseSurface(cylinder, 360, 120);
    for (const Vector3d& point : RandomPoints(cylinder, 60)) {
      const ClosestPoint closest = FindClosest(cylinder, point);
      double sampled = 1e9;
      for (const Vector3d& sample : surface) sampled = std::min(sampled, (sample - point).norm());
      const double distance = std::abs(closest.signed_distance_m);
      EXPECT_LE(distance, sampled + 1e-12);
      EXPECT_GE(distance, sampled - 0.004);
      EXPECT_NEAR((closest.point_m - point).norm(), distance, 1e-12);
      EXPECT_NEAR(FindClosest(cylinder, closest.point_m).signed_distance_m, 0.0, 1e-9);
    }
  }
}

TEST(FindClosest, NormalIsTheGradientOfTheSignedDistance) {
  for (const DegenerateCylinder& cylinder : RandomCylinders(20)) {
    for (const Vector3d& point : RandomPoints(cylinder, 40)) {
      const ClosestPoint closest = FindClosest(cylinder, point);
      if (closest.signed_distance_m < 0.0) continue;  // Inside it jumps at the medial surface.
      const double h = 1e-7;
      const Vector3d onward = point + h * closest.normal;
      EXPECT_NEAR(FindClosest(cylinder, onward).signed_distance_m - closest.signed_distance_m, h,
                  1e-11);
      EXPECT_NEAR(closest.normal.norm(), 1.0, 1e-12);
    }
  }
}

TEST(FindClosest, SignAgreesWithIsInside) {
  for (const DegenerateCylinder& cylinder : RandomCylinders(50)) {
    for (const Vector3d& point : RandomPoints(cylinder, 100)) {
      EXPECT_EQ(FindClosest(cylinder, point).signed_distance_m <= 0.0, IsInside(cylinder, point));
    }
  }
}

}  // namespace
}  // namespace deixis::geometry
