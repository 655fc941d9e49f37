#include "common/geometry/closest_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "test/common/geometry/cylinder_samples.h"

namespace deixis::geometry {
namespace {

using Eigen::Vector3d;

/// What FindClosestPoints finds, as vectors.
struct Found {
  std::vector<float> distance_m, nx, ny, nz;
};

Found FindAll(const DegenerateCylinder& cylinder, const std::vector<Vector3d>& points) {
  std::vector<float> x, y, z;
  for (const Vector3d& point : points) {
    x.push_back(static_cast<float>(point.x()));
    y.push_back(static_cast<float>(point.y()));
    z.push_back(static_cast<float>(point.z()));
  }
  const std::vector<float> room(points.size(), std::nanf(""));
  Found found{room, room, room, room};
  FindClosestPoints(cylinder, {x.data(), y.data(), z.data(), static_cast<int>(points.size())},
                    {found.distance_m.data(), found.nx.data(), found.ny.data(), found.nz.data()});
  return found;
}

double Percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values.at(static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

/// Errors of the distance over all limbs, millimetres.
std::vector<double> Errors_mm(double within_m, double from_m) {
  std::vector<double> errors;
  for (const DegenerateCylinder& limb : BodyLimbs()) {
    const std::vector<Vector3d> points = PointsNear(limb, within_m, 5000);
    const Found found = FindAll(limb, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double exact = FindClosest(limb, points[i]).signed_distance_m;
      if (std::abs(exact) < from_m) continue;
      errors.push_back(1e3 * std::abs(found.distance_m[i] - exact));
    }
  }
  return errors;
}

TEST(FindClosestPoints, KeepsItsErrorWithinThreeCentimetres) {
  const std::vector<double> errors = Errors_mm(0.03, 0.0);
  EXPECT_LE(Percentile(errors, 0.5), 0.001);
  EXPECT_LE(Percentile(errors, 0.99), 0.01);
}

TEST(FindClosestPoints, KeepsItsErrorWithinTenCentimetres) {
  const std::vector<double> errors = Errors_mm(0.10, 0.03);
  EXPECT_LE(Percentile(errors, 0.99), 0.1);
}

TEST(FindClosestPoints, NormalLeadsToTheClosestPoint) {
  for (const DegenerateCylinder& limb : BodyLimbs()) {
    const std::vector<Vector3d> points = PointsNear(limb, 0.03, 500);
    const Found found = FindAll(limb, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector3d normal(found.nx[i], found.ny[i], found.nz[i]);
      EXPECT_NEAR(normal.norm(), 1.0, 1e-5);
      const Vector3d foot = points[i] - found.distance_m[i] * normal;
      EXPECT_NEAR(FindClosest(limb, foot).signed_distance_m, 0.0, 5e-5);
    }
  }
}

TEST(FindClosestPoints, HasASensibleNormalOnTheSurface) {
  for (const DegenerateCylinder& limb : BodyLimbs()) {
    std::vector<Vector3d> points;
    for (double phi = 0.0; phi < 6.0; phi += 0.1) points.push_back(SidePoint(limb, phi, 0.5));
    const Found found = FindAll(limb, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector3d normal(found.nx[i], found.ny[i], found.nz[i]);
      EXPECT_GT(normal.dot(SideNormal(limb, 0.1 * static_cast<double>(i), 0.5)), 0.999);
    }
  }
}

TEST(FindClosestPoints, DealsWithEverySpecialCase) {
  const DegenerateCylinder round{0.1, 0.1, 0.1, 0.1, 0.5};
  const std::vector<Vector3d> points{{0.3, 0.4, 0.2},   {0.01, -0.02, -0.07}, {0.01, 0.0, 0.55},
                                     {0.13, 0.0, 0.54}, {0.06, 0.0, 0.25},    {0.01, 0.0, 0.49},
                                     {0.0, 0.0, 0.25},  {0.0, 0.0, 0.6}};
  const std::vector<float> expected{0.4F, 0.07F, 0.05F, 0.05F, -0.04F, -0.01F, -0.1F, 0.1F};
  const Found found = FindAll(round, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(found.distance_m[i], expected[i], 1e-6) << points[i].transpose();
  }
}

TEST(FindClosestPoints, GivesWhatIsNotFiniteBack) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Found found = FindAll(BodyLimbs()[0], {{nan, 0.0, 0.1}, {0.3, 0.0, 0.1}, {0.0, 0.0, nan}});
  EXPECT_FALSE(std::isfinite(found.distance_m[0]));
  EXPECT_TRUE(std::isfinite(found.distance_m[1]));
  EXPECT_FALSE(std::isfinite(found.distance_m[2]));
}

TEST(FindClosestPoints, DoesNothingWithoutPoints) { FindClosestPoints(BodyLimbs()[0], {}, {}); }

}  // namespace
}  // namespace deixis::geometry
