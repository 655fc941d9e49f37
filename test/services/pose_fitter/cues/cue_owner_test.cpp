#include "services/pose_fitter/core/cues/cue_owner.h"

#include <gtest/gtest.h>

#include "test/services/pose_fitter/synthetic_body.h"

namespace deixis::pose_fitter {
namespace {

class CueOwnerTest : public ::testing::Test {
 protected:
  CueOwnerTest() { kinematics_.Update(test::Gesturing(model_)); }
  PartCue CueAt(Part part, const Eigen::Vector3d& point_m) const {
    PartCue cue;
    cue.part = part;
    cue.ray = point_m / point_m.z();
    cue.distance_m = point_m.z();
    return cue;
  }
  Eigen::Vector3d Joint_m(const char* limb) const {
    return kinematics_.proximal_m(*model_.Find(limb));
  }

  body_model::BodyModel model_ = test::BodyOf("clothed_body");
  body_model::Kinematics kinematics_{model_};
};

TEST_F(CueOwnerTest, AHandIsWithinReachOfTheShoulders) {
  EXPECT_LT(Reaches(CueAt(Part::kHand, Joint_m("left_hand")), kinematics_), 1.0);
  EXPECT_LT(Reaches(CueAt(Part::kHand, Joint_m("right_hand")), kinematics_), 1.0);
  const Eigen::Vector3d far_m = Joint_m("left_upper_arm") + Eigen::Vector3d(1.2, 0.0, 0.0);
  EXPECT_GT(Reaches(CueAt(Part::kHand, far_m), kinematics_), 1.0);
}

TEST_F(CueOwnerTest, AHandBehindThePersonIsSomebodyElsesUnlessItsDistanceIsUnknown) {
  PartCue cue = CueAt(Part::kHand, 2.0 * Joint_m("left_hand"));
  EXPECT_GT(Reaches(cue, kinematics_), 1.0);
  cue.distance_m.reset();
  EXPECT_LT(Reaches(cue, kinematics_), 1.0);
}

TEST_F(CueOwnerTest, AFaceIsAtTheHead) {
  EXPECT_LT(Reaches(CueAt(Part::kFace, Joint_m("head")), kinematics_), 1.0);
  EXPECT_GT(Reaches(CueAt(Part::kFace, Joint_m("left_hand")), kinematics_), 1.0);
}

}  // namespace
}  // namespace deixis::pose_fitter
