#include "services/pose_fitter/core/limb_icp/limb_icp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/config/config.h"
#include "test/services/pose_fitter/synthetic_body.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;
using body_model::BodyPose;
using Eigen::Vector3d;
using test::JointError_m;

class LimbIcpTest : public ::testing::Test {
 protected:
  static double ErrorAfterFit_m(const std::string& plan, double noise_m, double start_m) {
    const BodyModel model = test::BodyOf(plan);
    const BodyPose truth = test::Gesturing(model);
    const BodyPoints points = test::PointsOf(test::Look(model, truth, 240, noise_m));
    LimbIcp fitter({}, model);
    BodyPose pose = test::Disturbed(model, truth, start_m);
    fitter.Fit(points, pose);
    return JointError_m(model, truth, pose);
  }
};

TEST_F(LimbIcpTest, FindsTheUpperBodyInExactPoints) {
  EXPECT_LT(ErrorAfterFit_m("upper_body", 0.0, 0.04), 0.015);
}

TEST_F(LimbIcpTest, FindsTheUpperBodyInNoisyPoints) {
  EXPECT_LT(ErrorAfterFit_m("upper_body", 0.008, 0.04), 0.02);
}

TEST_F(LimbIcpTest, FindsTheWholeBody) {
  EXPECT_LT(ErrorAfterFit_m("whole_body", 0.002, 0.04), 0.025);
}

// Its limbs are short, overlap, and slide along each other: not found, but no worse than before.
TEST_F(LimbIcpTest, ComesNearerToABodyOfShortLimbs) {
  EXPECT_LT(ErrorAfterFit_m("clothed_body", 0.002, 0.04), 0.033);
}

TEST_F(LimbIcpTest, StaysAtTheTruth) { EXPECT_LT(ErrorAfterFit_m("upper_body", 0.0, 0.0), 0.005); }

TEST_F(LimbIcpTest, KeepsThePreviousPoseWithoutPoints) {
  const BodyModel model = test::BodyOf("upper_body");
  const BodyPose before = test::Gesturing(model);
  BodyPose pose = before;
  LimbIcp fitter({}, model);
  const FitResult& result = fitter.Fit(BodyPoints{}, pose);
  EXPECT_LT(JointError_m(model, before, pose), 1e-9);
  EXPECT_EQ(fitter.cycles(), 1);
  for (const LimbEvidence& limb : result.limbs) {
    EXPECT_EQ(limb.inlier_count, 0);
    EXPECT_EQ(limb.residual_m, -1.0);
  }
}

TEST_F(LimbIcpTest, KeepsThePreviousPoseWhenAllPointsAreTooFar) {
  const BodyModel model = test::BodyOf("upper_body");
  const BodyPose before = test::Gesturing(model);
  BodyPose there = before;
  there.frame_from_root.translation_m.z() += 1.0;
  const BodyPoints points = test::PointsOf(test::Look(model, there, 160));
  BodyPose pose = before;
  LimbIcp fitter({}, model);
  fitter.Fit(points, pose);
  EXPECT_LT(JointError_m(model, before, pose), 1e-9);
}

TEST_F(LimbIcpTest, StopsWhenThePoseChangesLittle) {
  const BodyModel model = test::BodyOf("upper_body");
  const BodyPose truth = test::Gesturing(model);
  const BodyPoints points = test::PointsOf(test::Look(model, truth, 240));
  LimbIcpConfig config;
  config.iterations = 1000;
  config.least_change_m = 0.002;
  LimbIcp fitter(config, model);
  BodyPose pose = test::Disturbed(model, truth, 0.03);
  fitter.Fit(points, pose);
  EXPECT_GT(fitter.cycles(), 1);
  EXPECT_LT(fitter.cycles(), 100);
}

/// Points of a body whose right lower arm was cut off and moved.
struct CutArm {
  BodyModel model = test::BodyOf("upper_body");
  BodyPose truth = test::Gesturing(model);
  int arm = *model.Find("right_lower_arm");
  BodyPoints points;

  explicit CutArm(const Vector3d& shift_m) {
    const BodyPoints whole = test::PointsOf(test::Look(model, truth, 240));
    body_model::Kinematics kinematics(model);
    kinematics.Update(truth);
    LimbMatches matches(model);
    matches.Find(whole, kinematics, {});
    for (int i = 0; i < whole.count(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      Eigen::Vector3f point_m(whole.x_m[k], whole.y_m[k], whole.z_m[k]);
      if (matches.winners()[k] == arm) point_m += shift_m.cast<float>();
      points.Add(point_m, 0.003F);
    }
    points.EndBlock();
  }
};

TEST_F(LimbIcpTest, ClosesAGapBetweenLimbs) {
  const CutArm cut({0.0, 0.04, 0.0});
  BodyPose pose = cut.truth;
  LimbIcp fitter({}, cut.model);
  fitter.Fit(cut.points, pose);
  body_model::Kinematics kinematics(cut.model);
  kinematics.Update(pose);
  const int upper = cut.model.limbs()[static_cast<std::size_t>(cut.arm)].parent;
  const Vector3d elbow_m =
      kinematics.limb(upper) *
      cut.model.limbs()[static_cast<std::size_t>(cut.arm)].rest_in_parent.translation_m;
  EXPECT_LT((kinematics.proximal_m(cut.arm) - elbow_m).norm(), 1e-9);
  EXPECT_GT(JointError_m(cut.model, cut.truth, pose), 0.001) << "the arm did not follow its points";
}

TEST_F(LimbIcpTest, KeepsTheAnglesOfALimbThatLeavesItsJoint) {
  const CutArm cut({0.0, 0.05, 0.0});
  LimbIcpConfig config;
  config.connected_m = 0.005;
  config.iterations = 1;
  LimbIcp fitter(config, cut.model);
  BodyPose pose = cut.truth;
  fitter.Fit(cut.points, pose);
  const int first = cut.model.first_angle(cut.arm);
  EXPECT_NEAR(pose.angles_rad[first], cut.truth.angles_rad[first], 1e-12);
}

TEST_F(LimbIcpTest, DoesNotMindPointsThatAreNoNumbers) {
  const BodyModel model = test::BodyOf("upper_body");
  const BodyPose truth = test::Gesturing(model);
  BodyPoints points = test::PointsOf(test::Look(model, truth, 240));
  for (std::size_t i = 0; i < points.x_m.size(); i += 10) {
    points.z_m[i] = std::numeric_limits<float>::quiet_NaN();
  }
  LimbIcp fitter({}, model);
  BodyPose pose = test::Disturbed(model, truth, 0.02);
  fitter.Fit(points, pose);
  EXPECT_LT(JointError_m(model, truth, pose), 0.02);
  EXPECT_EQ(fitter.winners()[0], -1);
}

TEST_F(LimbIcpTest, RefusesSettingsThatMakeNoSense) {
  LimbIcpConfig config;
  config.reach_m = 0.0;
  EXPECT_THROW(config.Validate(), config::FaultsFound);
}

}  // namespace
}  // namespace deixis::pose_fitter
