#include "services/pose_fitter/core/bodies/loose_ends.h"

#include <gtest/gtest.h>

#include "test/services/pose_fitter/bodies/lost_limb.h"

namespace deixis::pose_fitter {
namespace {

class LooseEndsTest : public ::testing::Test {
 protected:
  const std::vector<Eigen::Vector3d>& Find(const body_model::BodyPose& pose,
                                           const ImageContext& context = {}) {
    scene_.See(pose, context);
    const int arm = *scene_.model_.Find("right_upper_arm");
    return ends_.Find(scene_.evidence_, scene_.kinematics_.proximal_m(arm), 0.7, context);
  }
  std::vector<std::uint8_t> AllPixels(std::uint8_t value) const {
    return std::vector<std::uint8_t>(scene_.view_.z_m().size(), value);
  }

  test::LostLimb scene_;
  LooseEnds ends_{LooseEndsConfig{}};
};

TEST_F(LooseEndsTest, AreNoneOfABodyWhoseLimbsAreAllKnown) {
  EXPECT_TRUE(Find(scene_.truth_).empty());
}

TEST_F(LooseEndsTest, EndWhereALostHandIs) {
  const auto& ends = Find(scene_.believed_);
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_LT((ends[0] - scene_.Wrist_m(scene_.truth_)).norm(), 0.25);
}

TEST_F(LooseEndsTest, AreNotSomebodyElsesNorTheRooms) {
  const auto taken = AllPixels(1), room = AllPixels(0);
  EXPECT_TRUE(Find(scene_.believed_, {&taken}).empty());
  EXPECT_TRUE(Find(scene_.believed_, {nullptr, &room}).empty());
}

TEST_F(LooseEndsTest, DoNotFloatInTheAir) {
  const int hand = *scene_.model_.Find("left_hand");
  scene_.kinematics_.Update(scene_.truth_);
  Eigen::Vector3d place_m = scene_.kinematics_.proximal_m(hand);
  place_m.z() -= 0.4;
  const auto pixel = scene_.picture_.camera.Project(place_m);
  const cv::Point at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
  cv::Mat depth_mm = scene_.picture_.depth_mm.clone();
  depth_mm(cv::Rect(at.x - 6, at.y - 30, 12, 20)).setTo(static_cast<int>(1000.0 * place_m.z()));
  scene_.view_.Update(scene_.picture_.camera, depth_mm);
  EXPECT_TRUE(Find(scene_.truth_).empty());
}

}  // namespace
}  // namespace deixis::pose_fitter
