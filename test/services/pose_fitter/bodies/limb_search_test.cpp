#include "services/pose_fitter/core/bodies/limb_search.h"

#include <gtest/gtest.h>

#include "test/services/pose_fitter/bodies/lost_limb.h"

namespace deixis::pose_fitter {
namespace {

class LimbSearchTest : public ::testing::Test {
 protected:
  std::optional<Hypothesis> Find(const body_model::BodyPose& pose, double seconds,
                                 const ImageContext& context = {}) {
    const Hypothesis now = scene_.See(pose, context);
    return search_.Find(scene_.evidence_, std::nullopt, context, seconds, now);
  }
  double Off_m(const body_model::BodyPose& pose) const {
    return (scene_.Wrist_m(pose) - scene_.Wrist_m(scene_.truth_)).norm();
  }

  test::LostLimb scene_;
  LimbSearchConfig config_;
  LimbSearch search_{config_, BodyEvidenceConfig{}, BodyFitterConfig{}, scene_.model_};
};

TEST_F(LimbSearchTest, FindsAnArmThatIsElsewhere) {
  const auto found = Find(scene_.believed_, config_.period_s);
  ASSERT_TRUE(found.has_value());
  EXPECT_GT(Off_m(scene_.believed_), 0.3);
  EXPECT_LT(Off_m(found->pose), 0.04);
}

TEST_F(LimbSearchTest, LeavesABodyAloneThatIsRight) {
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(Find(scene_.truth_, config_.period_s).has_value());
}

TEST_F(LimbSearchTest, RestsBetweenSearches) {
  EXPECT_FALSE(Find(scene_.believed_, 0.5 * config_.period_s).has_value());
  EXPECT_TRUE(Find(scene_.believed_, 0.5 * config_.period_s).has_value());
}

TEST_F(LimbSearchTest, AHandThatWasRecognisedElsewhereIsLookedAt) {
  PartCue cue;
  const Eigen::Vector3d hand_m = scene_.Wrist_m(scene_.truth_);
  cue.ray = hand_m / hand_m.z();
  cue.distance_m = hand_m.z() - 0.02;
  cue.right_probability = 0.9;
  const std::vector<PartCue> cues{cue};
  const auto found = Find(scene_.believed_, config_.period_s, {nullptr, nullptr, &cues});
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(Off_m(found->pose), 0.04);
  EXPECT_LT(found->result.cue_cost, 0.4) << "it was 1";
}

}  // namespace
}  // namespace deixis::pose_fitter
