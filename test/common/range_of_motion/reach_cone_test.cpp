#include "common/range_of_motion/reach_cone.h"

#include <gmock/gmock.h>

#include <cmath>
#include <stdexcept>

namespace deixis::range_of_motion {
namespace {

using Eigen::Vector3d;

/// At `around` about z, `away` from it, degrees.
Vector3d At(double around_deg, double away_deg) {
  const double around = around_deg * M_PI / 180.0, away = away_deg * M_PI / 180.0;
  return {std::sin(away) * std::cos(around), std::sin(away) * std::sin(around), std::cos(away)};
}

ReachCone Square() {
  return ReachCone(
      {{"ahead", At(0, 40)}, {"left", At(90, 80)}, {"back", At(180, 60)}, {"right", At(-90, 100)}});
}

double Boundary_deg(const ReachCone& cone, double around_deg) {
  return cone.Find(At(around_deg, 10.0)).boundary_rad * 180.0 / M_PI;
}

TEST(ReachCone, EndsAtItsKnots) {
  const ReachCone cone = Square();
  EXPECT_NEAR(Boundary_deg(cone, 0), 40.0, 1e-9);
  EXPECT_NEAR(Boundary_deg(cone, 90), 80.0, 1e-9);
  EXPECT_NEAR(Boundary_deg(cone, 180), 60.0, 1e-9);
  EXPECT_NEAR(Boundary_deg(cone, -90), 100.0, 1e-9);
}

TEST(ReachCone, ChangesLinearlyBetweenKnotsAllAround) {
  const ReachCone cone = Square();
  EXPECT_NEAR(Boundary_deg(cone, 45), 60.0, 1e-9);
  EXPECT_NEAR(Boundary_deg(cone, 135), 70.0, 1e-9);
  EXPECT_NEAR(Boundary_deg(cone, -135), 80.0, 1e-9);
  EXPECT_NEAR(Boundary_deg(cone, -45), 70.0, 1e-9);
  for (double around = -180.0; around < 180.0; around += 1.0) {
    EXPECT_NEAR(Boundary_deg(cone, around), Boundary_deg(cone, around + 1.0), 1.0) << around;
  }
}

TEST(ReachCone, NamesTheNearestKnot) {
  const ReachCone cone = Square();
  EXPECT_EQ(cone.motion(cone.Find(At(40, 10)).knot), "ahead");
  EXPECT_EQ(cone.motion(cone.Find(At(50, 10)).knot), "left");
  EXPECT_EQ(cone.motion(cone.Find(At(170, 10)).knot), "back");
  EXPECT_EQ(cone.motion(cone.Find(At(-100, 10)).knot), "right");
}

TEST(ReachCone, MeasuresTheAngleFromTheRestDirection) {
  EXPECT_NEAR(Square().Find(At(30, 150)).angle_rad, 150.0 * M_PI / 180.0, 1e-12);
  EXPECT_EQ(Square().Find(Vector3d::UnitZ()).angle_rad, 0.0);
}

TEST(ReachCone, RefusesKnotsThatDoNotGoAround) {
  EXPECT_THROW(ReachCone({{"", At(0, 40)}, {"", At(90, 40)}, {"", At(170, 40)}}),
               std::invalid_argument);
  EXPECT_THROW(ReachCone({{"", At(0, 40)}}), std::invalid_argument);
}

TEST(ReachCone, RefusesAKnotAtTheRestDirection) {
  EXPECT_THROW(ReachCone({{"", At(0, 0)}, {"", At(120, 40)}, {"", At(-120, 40)}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace deixis::range_of_motion
