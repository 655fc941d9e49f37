#include "services/pose_fitter/core/pose_fitter.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "common/config/config.h"
#include "test/services/pose_fitter/synthetic_person.h"

namespace deixis::pose_fitter {
namespace {

using test::Room;

constexpr std::int64_t kPeriod_us = 33'333;
constexpr int kWidth_px = 240;

PoseFitterConfig WithShippedBody() {
  setenv("DEIXIS_CONFIG_DIR", DEIXIS_SOURCE_DIR "/config", 1);
  return {};
}

class PoseFitterTest : public ::testing::Test {
 protected:
  const body_model::BodyPoses& Show(const test::Picture& picture) {
    time_.microseconds += kPeriod_us;
    return fitter_.Track({time_, "STEREO", picture.depth_mm}, test::CalibrationOf(picture));
  }
  test::Picture WithPerson(const body_model::BodyPose& pose) {
    test::Picture picture = test::Look(room_, kWidth_px);
    test::Draw(body_, pose, 1, picture);
    return picture;
  }
  /// Largest distance of a joint of the body from the true one.
  double WorstJoint_m(const body_model::TrackedBody& found, const body_model::BodyPose& truth) {
    body_model::Kinematics kinematics(body_);
    kinematics.Update(truth);
    double worst_m = 0.0;
    for (int limb = 0; limb < body_.limb_count(); ++limb) {
      const auto& place = found.limbs[static_cast<std::size_t>(limb)];
      const double off_m = (place.proximal_m - kinematics.proximal_m(limb)).norm();
      if (off_m > worst_m) {
        worst_m = off_m;
        worst_limb_ = body_.limbs()[static_cast<std::size_t>(limb)].name;
      }
    }
    return worst_m;
  }

  Room room_;
  body_model::BodyModel body_ = test::ClothedBody();
  PoseFitter fitter_{WithShippedBody()};
  Timestamp time_{1'000'000};
  std::string worst_limb_;
};

TEST_F(PoseFitterTest, FindsTheJointsOfSomebodyWhoStands) {
  const auto pose = test::StandingIn(room_, body_, 0.2, 2.6, 0.3);
  const auto picture = WithPerson(pose);
  for (int i = 0; i < 30; ++i) Show(picture);
  const auto& poses = Show(picture);
  ASSERT_EQ(poses.bodies.size(), 1U);
  EXPECT_EQ(poses.bodies[0].state, body_model::BodyState::kTracked);
  EXPECT_LT(WorstJoint_m(poses.bodies[0], pose), 0.05) << worst_limb_;
  ASSERT_TRUE(poses.floor);
  EXPECT_NEAR(poses.floor->offset_m, room_.camera_height_m, 0.03);
}

TEST_F(PoseFitterTest, FollowsArmsThatAreRaised) {
  body_model::BodyPose pose;
  for (int i = 0; i <= 40; ++i) {
    pose = test::StandingIn(room_, body_, 0.0, 2.6, 0.1 + 0.03 * i);
    Show(WithPerson(pose));
  }
  const auto& poses = Show(WithPerson(pose));
  ASSERT_EQ(poses.bodies.size(), 1U);
  EXPECT_LT(WorstJoint_m(poses.bodies[0], pose), 0.06) << worst_limb_;
}

TEST_F(PoseFitterTest, KeepsTheNumberOfSomebodyWhoWalksAndForgetsWhoHasGone) {
  int id = -1;
  for (int i = 0; i < 30; ++i) {
    const auto& poses = Show(WithPerson(test::StandingIn(room_, body_, -0.3 + 0.02 * i, 2.6)));
    ASSERT_EQ(poses.bodies.size(), 1U) << i;
    if (i == 0) id = poses.bodies[0].person_id;
    EXPECT_EQ(poses.bodies[0].person_id, id) << i;
  }
  const auto empty = test::Look(room_, kWidth_px);
  EXPECT_EQ(Show(empty).bodies[0].state, body_model::BodyState::kLost);
  for (int i = 0; i < 70; ++i) Show(empty);
  EXPECT_TRUE(Show(empty).bodies.empty());
}

TEST_F(PoseFitterTest, FindsSomebodyOnASofaWithoutAFloor) {
  room_.has_floor = false;
  room_.pitch_rad = 0.0;
  room_.Add(test::Box{{-1.6, 2.75, 0.0}, {1.6, 3.4, 0.9}});
  for (int i = 0; i < 20; ++i) {
    Show(WithPerson(test::StandingIn(room_, body_, 0.0, 2.6, 0.3 + 0.05 * i)));
  }
  const auto pose = test::StandingIn(room_, body_, 0.0, 2.6, 1.3);
  const auto& poses = Show(WithPerson(pose));
  ASSERT_EQ(poses.bodies.size(), 1U);
  const auto& root = poses.bodies[0].pose.frame_from_root;
  EXPECT_LT((root.translation_m - pose.frame_from_root.translation_m).norm(), 0.1);
}

TEST_F(PoseFitterTest, TakesNoFurnitureThatHasAHeadForPeople) {
  room_.Add(test::Box{{0.5, 2.4, 0.0}, {1.0, 2.8, 1.0}});
  room_.Add(test::Ball{{0.75, 2.6, 1.12}, 0.12});
  const auto picture = test::Look(room_, kWidth_px);
  for (int i = 0; i < 30; ++i) EXPECT_TRUE(Show(picture).bodies.empty()) << i;
}

TEST_F(PoseFitterTest, SeesNobodyWhereNothingWasMeasured) {
  auto picture = test::Look(room_, kWidth_px);
  picture.depth_mm.setTo(0);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(Show(picture).bodies.empty());
}

TEST_F(PoseFitterTest, KeepsEveryAngleWithinItsEnvelope) {
  const auto picture = WithPerson(test::StandingIn(room_, body_, 0.0, 2.4, 0.8));
  for (int i = 0; i < 10; ++i) Show(picture);
  ASSERT_EQ(fitter_.Models().size(), 1U);
  const auto model = fitter_.Models()[0].body;
  const auto& body = Show(picture).bodies.at(0);
  int angle = 0;
  for (const auto& limb : model.limbs()) {
    for (const auto& dof : limb.dofs) {
      EXPECT_GE(body.pose.angles_rad[angle], dof.angle_min_rad - 1e-9) << limb.name << dof.name;
      EXPECT_LE(body.pose.angles_rad[angle], dof.angle_max_rad + 1e-9) << limb.name << dof.name;
      ++angle;
    }
  }
}

TEST(PoseFitter, NamesABodyModelThatIsNotThere) {
  PoseFitterConfig config = WithShippedBody();
  config.body_model = "body_models/centaur.yaml";
  try {
    const PoseFitter fitter(config);
    FAIL() << "was accepted";
  } catch (const config::ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("centaur.yaml"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace deixis::pose_fitter
