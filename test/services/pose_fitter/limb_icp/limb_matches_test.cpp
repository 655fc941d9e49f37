#include "services/pose_fitter/core/limb_icp/limb_matches.h"

#include <gtest/gtest.h>

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;

/// Two equal limbs side by side, 0.2 m apart along x, both along z.
BodyModel Twins() {
  body_model::Limb one;
  one.name = "one";
  one.shape.a0_m = one.shape.b0_m = one.shape.a1_m = one.shape.b1_m = 0.05;
  one.shape.length_m = 0.4;
  body_model::Limb other = one;
  other.name = "other";
  other.parent = 0;
  other.rest_in_parent.translation_m = {0.2, 0.0, 0.0};
  return BodyModel("twins", {one, other});
}

struct LimbMatchesTest : ::testing::Test {
  BodyModel model = Twins();
  body_model::Kinematics kinematics{model};
  LimbMatches matches{model};

  void FindOne(const Eigen::Vector3f& point_m) {
    body_model::BodyPose pose = body_model::RestPose(model);
    pose.frame_from_root.translation_m = {0.0, 0.0, 2.0};
    kinematics.Update(pose);
    BodyPoints points;
    points.Add(point_m + Eigen::Vector3f(0.0F, 0.0F, 2.0F), 0.003F);
    points.EndBlock();
    matches.Find(points, kinematics, {0.1, 1e-3});
  }
};

TEST_F(LimbMatchesTest, GivesAPointToTheNearestLimb) {
  FindOne({0.13F, 0.0F, 0.2F});
  EXPECT_EQ(matches.winners()[0], 1);
  EXPECT_EQ(matches.pairs(0).count, 0);
  ASSERT_EQ(matches.pairs(1).count, 1);
  EXPECT_LT((matches.pairs(1).from_m - Eigen::Vector3d(-0.05, 0.0, 0.2)).norm(), 1e-4);
  EXPECT_LT((matches.pairs(1).to_m - Eigen::Vector3d(-0.07, 0.0, 0.2)).norm(), 1e-4);
}

TEST_F(LimbMatchesTest, CountsAPointInEqualDistanceForEachLimb) {
  FindOne({0.1F, 0.0F, 0.2F});
  EXPECT_EQ(matches.pairs(0).count, 1);
  EXPECT_EQ(matches.pairs(1).count, 1);
}

TEST_F(LimbMatchesTest, LeavesOutPointsThatAreTooFar) {
  FindOne({0.1F, 0.2F, 0.2F});
  EXPECT_EQ(matches.winners()[0], -1);
  EXPECT_EQ(matches.pairs(0).count + matches.pairs(1).count, 0);
}

TEST_F(LimbMatchesTest, FindsTheDiscAtTheEndOfALimb) {
  FindOne({0.01F, 0.0F, 0.45F});
  ASSERT_EQ(matches.pairs(0).count, 1);
  EXPECT_LT((matches.pairs(0).from_m - Eigen::Vector3d(0.01, 0.0, 0.4)).norm(), 1e-4);
}

}  // namespace
}  // namespace deixis::pose_fitter
