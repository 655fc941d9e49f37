#include "services/pose_fitter/core/fitting/cue_term.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "common/body_model/joint_angles.h"
#include "test/services/pose_fitter/synthetic_body.h"

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector3d;

class CueTermTest : public ::testing::Test {
 protected:
  CueTermTest() { kinematics_.Update(pose_); }
  Vector3d Hand_m(const char* limb) const {
    const int hand = *model_.Find(limb);
    return 0.65 * kinematics_.proximal_m(hand) + 0.35 * kinematics_.distal_m(hand);
  }
  static PartCue CueOn(Part part, const Vector3d& point_m, double right_probability = 0.5) {
    PartCue cue;
    cue.part = part;
    cue.ray = point_m / point_m.z();
    cue.right_probability = right_probability;
    return cue;
  }
  /// One step of the whole body, held a little where it is.
  void Step(const std::vector<PartCue>& cues) {
    LimbEquations limbs(model_.limb_count());
    limbs.SetZero(kinematics_.proximal_m(0));
    term_.AddTo(cues, kinematics_, 1.0, limbs);
    BodyEquations equations;
    equations.SetZero(6 + model_.angle_count());
    limbs.AddTo(kinematics_, equations);
    equations.information.diagonal().array() += 1.0;
    equations.information.diagonal().head<6>().array() += 1e6;
    const Eigen::VectorXd step = equations.information.ldlt().solve(equations.pull);
    pose_.angles_rad += step.tail(model_.angle_count());
    kinematics_.Update(pose_);
  }

  body_model::BodyModel model_ = test::BodyOf("clothed_body");
  body_model::BodyPose pose_ = test::Gesturing(model_);
  body_model::Kinematics kinematics_{model_};
  CueTerm term_{CueConfig{}, model_};
};

TEST_F(CueTermTest, PullsAHandOntoItsRay) {
  const Vector3d wanted_m = Hand_m("left_hand") + Vector3d(0.0, -0.08, 0.0);
  const PartCue cue = CueOn(Part::kHand, wanted_m, 0.1);
  for (int i = 0; i < 10; ++i) Step({cue});
  const Vector3d found_m = Hand_m("left_hand");
  EXPECT_LT((found_m / found_m.z() - cue.ray).norm(), 0.005);
}

TEST_F(CueTermTest, PullsAHandToItsDistanceWhereThatIsKnown) {
  const Vector3d before_m = Hand_m("left_hand");
  PartCue cue = CueOn(Part::kHand, before_m, 0.1);
  cue.distance_m = before_m.z() - 0.1;
  for (int i = 0; i < 20; ++i) Step({cue});
  EXPECT_LT(Hand_m("left_hand").z(), before_m.z() - 0.05);
}

TEST_F(CueTermTest, GivesEachHandItsOwnCue) {
  const std::vector<PartCue> cues{CueOn(Part::kHand, Hand_m("left_hand"), 0.1),
                                  CueOn(Part::kHand, Hand_m("right_hand"), 0.9)};
  EXPECT_NEAR(term_.Cost(cues, kinematics_), 0.0, 0.05);
  EXPECT_EQ(term_.cue_of_hand()[0], 1);
  EXPECT_EQ(term_.cue_of_hand()[1], 0);
}

TEST_F(CueTermTest, PlaceCountsForMoreThanTheSideThatWasToldWrongly) {
  const std::vector<PartCue> cues{CueOn(Part::kHand, Hand_m("left_hand"), 1.0),
                                  CueOn(Part::kHand, Hand_m("right_hand"), 0.0)};
  term_.Cost(cues, kinematics_);
  EXPECT_EQ(term_.cue_of_hand()[0], 1);
  EXPECT_EQ(term_.cue_of_hand()[1], 0);
}

TEST_F(CueTermTest, CostsOneForEachHandThatIsElsewhere) {
  const Vector3d elsewhere_m = Hand_m("left_hand") + Vector3d(1.5, 0.0, 0.0);
  EXPECT_NEAR(term_.Cost({CueOn(Part::kHand, elsewhere_m)}, kinematics_), 1.0, 0.05);
  EXPECT_EQ(term_.Cost({}, kinematics_), 0.0);
}

TEST_F(CueTermTest, AFaceIsSeenFromBefore) {
  const int head = *model_.Find("head");
  const auto& shape = model_.limbs()[static_cast<std::size_t>(head)].shape;
  const auto face_m = [&] {
    return Vector3d(kinematics_.limb(head) * Vector3d(shape.centre0_m.x() + shape.a0_m, 0, 0));
  };
  EXPECT_LT(term_.Cost({CueOn(Part::kFace, face_m())}, kinematics_), 0.1);
  pose_.frame_from_root.rotation =
      pose_.frame_from_root.rotation * Eigen::Quaterniond(0.0, 0.0, 0.0, 1.0);
  kinematics_.Update(pose_);
  EXPECT_NEAR(term_.Cost({CueOn(Part::kFace, face_m())}, kinematics_), 1.0, 1e-9);
}

}  // namespace
}  // namespace deixis::pose_fitter
