#include "services/pose_fitter/core/fitting/body_fitter.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "test/services/pose_fitter/synthetic_person.h"

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector3d;

class BodyFitterTest : public ::testing::Test {
 protected:
  FitResult Fit(body_model::BodyPose& pose, std::optional<double> seconds = std::nullopt) {
    view_.Update(picture_.camera, picture_.depth_mm);
    body_model::Kinematics kinematics(body_);
    evidence_.Gather(view_, kinematics, {&pose}, room_.Floor(), {}, 0.15);
    const body_model::BodyPose predicted = pose;
    return fitter_.Fit(evidence_, room_.Floor(), predicted, seconds, pose);
  }
  double WorstJoint_m(const body_model::BodyPose& pose) const {
    body_model::Kinematics found(body_), truth(body_);
    found.Update(pose);
    truth.Update(truth_);
    double worst_m = 0.0;
    for (int limb = 0; limb < body_.limb_count(); ++limb) {
      worst_m = std::max(worst_m, (found.proximal_m(limb) - truth.proximal_m(limb)).norm());
    }
    return worst_m;
  }
  void ExpectWithinEnvelope(const body_model::BodyPose& pose) const {
    EXPECT_TRUE(pose.frame_from_root.translation_m.allFinite());
    EXPECT_NEAR(pose.frame_from_root.rotation.norm(), 1.0, 1e-9);
    int angle = 0;
    for (const auto& limb : body_.limbs()) {
      for (const auto& dof : limb.dofs) {
        EXPECT_GE(pose.angles_rad[angle], dof.angle_min_rad) << limb.name << ' ' << dof.name;
        EXPECT_LE(pose.angles_rad[angle], dof.angle_max_rad) << limb.name << ' ' << dof.name;
        ++angle;
      }
    }
  }

  test::Room room_;
  body_model::BodyModel body_ = test::ClothedBody();
  body_model::BodyPose truth_ = test::StandingIn(room_, body_, 0.0, 2.5);
  test::Picture picture_ = [this] {
    test::Picture picture = test::Look(room_, 240);
    test::Draw(body_, truth_, 1, picture);
    return picture;
  }();
  DepthView view_;
  BodyEvidence evidence_{BodyEvidenceConfig{}};
  BodyFitter fitter_{BodyFitterConfig{}, body_};
};

TEST_F(BodyFitterTest, ComesBackFromSixtyMillimetresBeside) {
  for (const Vector3d& off_m :
       {Vector3d(0.06, 0.0, 0.01), Vector3d(0.0, 0.04, 0.04), Vector3d(-0.035, -0.035, -0.035)}) {
    body_model::BodyPose pose = truth_;
    pose.frame_from_root.translation_m += off_m;
    ASSERT_GT(WorstJoint_m(pose), 0.05);
    for (int i = 0; i < 4; ++i) Fit(pose);  // As from image to image.
    EXPECT_LT(WorstJoint_m(pose), 0.03) << off_m.transpose();
    ExpectWithinEnvelope(pose);
  }
}

TEST_F(BodyFitterTest, StaysAtTheTruthAndScoresItBetterThanAnythingElse) {
  body_model::BodyPose pose = truth_;
  const FitResult at_truth = Fit(pose, 0.033);
  EXPECT_LT(WorstJoint_m(pose), 0.02);
  EXPECT_GT(at_truth.explained, 0.9);
  EXPECT_GT(at_truth.trunk_seen, 0.8);
  body_model::BodyPose elsewhere = truth_;
  elsewhere.frame_from_root.translation_m.x() += 0.5;
  EXPECT_GT(Fit(elsewhere).score, 2.0 * at_truth.score);
}

TEST_F(BodyFitterTest, SaysWhatEachLimbRestsOn) {
  body_model::BodyPose pose = truth_;
  const FitResult result = Fit(pose);
  int inliers = 0;
  for (const LimbEvidence& limb : result.limbs) {
    inliers += limb.inlier_count;
    if (limb.inlier_count == 0) {
      EXPECT_EQ(limb.residual_m, -1.0);
    } else {
      EXPECT_GE(limb.residual_m, 0.0);
      EXPECT_LT(limb.residual_m, 0.05);
    }
  }
  EXPECT_NEAR(result.explained, 1.0 * inliers / evidence_.points().count(), 1e-12);
  EXPECT_GT(result.limbs[0].inlier_count, 50);
}

TEST_F(BodyFitterTest, KeepsAnglesWithinTheEnvelopeFromAnImpossiblePosture) {
  body_model::BodyPose pose = truth_;
  pose.angles_rad.array() += 1.5;
  Fit(pose);
  ExpectWithinEnvelope(pose);
}

TEST_F(BodyFitterTest, StaysFiniteWithoutPoints) {
  picture_.depth_mm.setTo(0);
  body_model::BodyPose pose = truth_;
  const FitResult result = Fit(pose);
  EXPECT_EQ(evidence_.points().count(), 0);
  EXPECT_TRUE(std::isfinite(result.score));
  EXPECT_EQ(result.explained, 0.0);
  ExpectWithinEnvelope(pose);
}

TEST_F(BodyFitterTest, StaysFiniteWithAPatchThatHoldsNothingInPlace) {
  const cv::Mat all = picture_.depth_mm.clone();
  picture_.depth_mm.setTo(0);
  const cv::Rect patch(picture_.depth_mm.cols / 2 - 4, picture_.depth_mm.rows / 2 - 4, 8, 8);
  all(patch).copyTo(picture_.depth_mm(patch));
  body_model::BodyPose pose = truth_;
  Fit(pose);
  ASSERT_GT(evidence_.points().count(), 0);
  ExpectWithinEnvelope(pose);
  EXPECT_TRUE(fitter_.information().allFinite());
}

TEST_F(BodyFitterTest, StaysFiniteInNoise) {
  cv::RNG random(3);
  random.fill(picture_.depth_mm, cv::RNG::UNIFORM, 0, 65535);
  body_model::BodyPose pose = truth_;
  EXPECT_TRUE(std::isfinite(Fit(pose).score));
  ExpectWithinEnvelope(pose);
}

TEST_F(BodyFitterTest, GivesTheSameForTheSame) {
  body_model::BodyPose first = truth_, second = truth_;
  first.frame_from_root.translation_m.x() += 0.03;
  second.frame_from_root.translation_m.x() += 0.03;
  Fit(first);
  Fit(second);
  EXPECT_EQ(first.angles_rad, second.angles_rad);
  EXPECT_EQ(first.frame_from_root.translation_m, second.frame_from_root.translation_m);
}

}  // namespace
}  // namespace deixis::pose_fitter
