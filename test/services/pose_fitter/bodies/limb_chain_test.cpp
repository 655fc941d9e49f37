#include "services/pose_fitter/core/bodies/limb_chain.h"

#include <gtest/gtest.h>

#include "test/services/pose_fitter/synthetic_body.h"

namespace deixis::pose_fitter {
namespace {

std::string NameOf(const body_model::BodyModel& model, int limb) {
  return model.limbs()[static_cast<std::size_t>(limb)].name;
}

TEST(LimbChain, HangsOnTheTrunkEvenWhenAClavicleIsBetween) {
  const auto model = test::BodyOf("clothed_body");
  const auto arm = LimbsOf(model, Chain::kLeftArm);
  ASSERT_TRUE(arm.has_value());
  EXPECT_EQ(NameOf(model, arm->trunk), "chest");
  EXPECT_EQ(NameOf(model, arm->upper), "left_upper_arm");
  EXPECT_EQ(NameOf(model, arm->end), "left_hand");
  const auto leg = LimbsOf(model, Chain::kRightLeg);
  ASSERT_TRUE(leg.has_value());
  EXPECT_EQ(NameOf(model, leg->lower), "right_shank");
  EXPECT_EQ(leg->trunk, 0);
}

TEST(LimbChain, ReachesToTheMiddleOfAHandAndToAnAnkle) {
  const auto model = test::BodyOf("clothed_body");
  const auto arm = LimbsOf(model, Chain::kRightArm), leg = LimbsOf(model, Chain::kRightLeg);
  EXPECT_NEAR(arm->upper_m + arm->lower_m, 0.56, 0.05);
  EXPECT_NEAR(leg->upper_m + leg->lower_m, 0.86, 0.08);
}

TEST(LimbChain, IsNoneOfABodyThatLacksIt) {
  const auto model = test::BodyOf("right_arm");
  EXPECT_FALSE(LimbsOf(model, Chain::kLeftArm).has_value());
  EXPECT_FALSE(LimbsOf(model, Chain::kRightLeg).has_value());
}

}  // namespace
}  // namespace deixis::pose_fitter
