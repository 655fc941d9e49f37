#include "services/pose_fitter/trainer/limb_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"
#include "test/services/pose_fitter/trainer/standing_person.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;
using Eigen::Vector3d;
using geometry::DegenerateCylinder;

/// Points of the side, from `from_rad` on for `arc_rad`.
std::vector<Vector3d> Points(const DegenerateCylinder& cylinder, double from_rad, double arc_rad) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.02, 0.98);
  std::normal_distribution<double> noise(0.0, 0.002);
  std::vector<Vector3d> points;
  for (int i = 0; i < 600; ++i) {
    const double phi_rad = from_rad + arc_rad * share(random), s = share(random);
    points.push_back(geometry::SidePoint(cylinder, phi_rad, s) +
                     noise(random) * geometry::SideNormal(cylinder, phi_rad, s));
  }
  return points;
}

const DegenerateCylinder kExpected{0.06, 0.06, 0.04, 0.04, 0.4, {0.0, 0.0}, {0.0, 0.0}};
const DegenerateCylinder kTrue{0.075, 0.065, 0.045, 0.035, 0.4, {0.012, -0.008}, {-0.01, 0.006}};

TEST(FitCylinder, FindsTheShapeThatIsSeenAllRound) {
  const auto found =
      FitCylinder(kExpected, kExpected, Points(kTrue, -M_PI, 2.0 * M_PI), false, 1.7);
  EXPECT_NEAR(found.a0_m, kTrue.a0_m, 0.002);
  EXPECT_NEAR(found.b0_m, kTrue.b0_m, 0.002);
  EXPECT_NEAR(found.a1_m, kTrue.a1_m, 0.002);
  EXPECT_NEAR(found.b1_m, kTrue.b1_m, 0.002);
  EXPECT_LT((found.centre0_m - kTrue.centre0_m).norm(), 0.002);
  EXPECT_LT((found.centre1_m - kTrue.centre1_m).norm(), 0.002);
}

TEST(FitCylinder, ExplainsOneSideWhenNoOtherIsSeen) {
  const auto points = Points(kTrue, -1.2, 2.4);
  const auto found = FitCylinder(kExpected, kExpected, points, false, 1.7);
  double sum = 0.0;
  for (const Vector3d& point : points) {
    sum += std::pow(geometry::FindClosest(found, point).signed_distance_m, 2);
  }
  EXPECT_LT(std::sqrt(sum / static_cast<double>(points.size())), 0.003);
}

TEST(FitCylinder, KeepsWhatIsInTheMiddleSymmetric) {
  const auto found = FitCylinder(kExpected, kExpected, Points(kTrue, -M_PI, 2.0 * M_PI), true, 1.7);
  EXPECT_EQ(found.centre0_m.y(), 0.0);
  EXPECT_EQ(found.centre1_m.y(), 0.0);
}

TEST(FitCylinder, StaysAsExpectedWithoutPoints) {
  const auto found = FitCylinder(kExpected, kTrue, {}, false, 1.7);
  EXPECT_NEAR(found.a0_m, kExpected.a0_m, 1e-9);
  EXPECT_NEAR(found.centre1_m.x(), 0.0, 1e-9);
}

class SurfaceOfAStandingPerson : public testing::Test {
 protected:
  SurfaceOfAStandingPerson() : model_(Build(StartPlan(), TallSizes())) {
    frame_.pose = body_model::Standing(model_);
    frame_.pose.frame_from_root = CameraFromRoot();
    kinematics_.Update(frame_.pose);
  }
  int Find(const char* limb) const { return model_.Find(limb).value(); }
  /// On the front of a limb, `beyond_m` before its surface.
  SurfacePoint OnFront(const char* limb, double beyond_m, int part) const {
    const auto& shape = model_.limbs()[static_cast<std::size_t>(Find(limb))].shape;
    const Eigen::Isometry3d& place = kinematics_.limb(Find(limb));
    const Vector3d normal = place.linear() * geometry::SideNormal(shape, 0.0, 0.5);
    return {place * geometry::SidePoint(shape, 0.0, 0.5) + beyond_m * normal, normal, part};
  }

  BodyModel model_;
  body_model::Kinematics kinematics_{model_};
  PosedSurface frame_;
};

TEST_F(SurfaceOfAStandingPerson, BelongsToTheLimbsThatItLiesOn) {
  frame_.points = {OnFront("right_thigh", 0.01, 1), OnFront("left_shank", -0.01, 1),
                   OnFront("right_lower_arm", 0.0, 3)};
  const auto assigned = AssignPoints(model_, {frame_}, 0.05);
  EXPECT_EQ(assigned[0].limb, Find("right_thigh"));
  EXPECT_NEAR(assigned[0].distance_m, 0.01, 1e-6);
  EXPECT_EQ(assigned[1].limb, Find("left_shank"));
  EXPECT_NEAR(assigned[1].distance_m, -0.01, 1e-6);
  EXPECT_EQ(assigned[2].limb, Find("right_lower_arm"));
}

TEST_F(SurfaceOfAStandingPerson, BelongsToNoLimbOfAnotherLabelDirectionOrPlace) {
  SurfacePoint turned = OnFront("right_thigh", 0.0, 1);
  turned.normal = -turned.normal;
  frame_.points = {OnFront("right_thigh", 0.0, 4), turned, OnFront("right_thigh", 0.2, 1)};
  for (const LimbPoint& point : AssignPoints(model_, {frame_}, 0.05)) EXPECT_EQ(point.limb, -1);
}

TEST_F(SurfaceOfAStandingPerson, IsMeasuredByWhatIsExplained) {
  frame_.points = {OnFront("right_thigh", 0.01, 1), OnFront("left_shank", -0.01, 1),
                   OnFront("left_shank", 0.3, 1), OnFront("left_shank", 0.3, 1)};
  const SurfaceError error = MeasureSurface(model_, {frame_});
  EXPECT_NEAR(error.rms_m, 0.01, 1e-6);
  EXPECT_DOUBLE_EQ(error.explained, 0.5);
  EXPECT_EQ(error.points, 4u);
}

}  // namespace
}  // namespace deixis::pose_fitter
