#include "services/pose_fitter/core/bodies/followed_person.h"

#include <gtest/gtest.h>

#include "test/services/pose_fitter/synthetic_person.h"

namespace deixis::pose_fitter {
namespace {

constexpr double kPeriod_s = 0.1;

/// A still person, and what may be his poses.
class FollowedPersonTest : public ::testing::Test {
 protected:
  FollowedPersonTest() {
    test::Draw(person_.model, truth_, 1, picture_);
    taken_.assign(picture_.depth_mm.total(), 0);
  }
  Hypothesis At(const body_model::BodyPose& pose, double score) const {
    Hypothesis hypothesis;
    hypothesis.pose = pose;
    hypothesis.rates_rad_per_s.setZero(person_.model.angle_count());
    const int parameters = 6 + person_.model.angle_count();
    hypothesis.information = 1e4 * Eigen::MatrixXd::Identity(parameters, parameters);
    hypothesis.result.limbs.resize(static_cast<std::size_t>(person_.model.limb_count()));
    hypothesis.mean_score = score;
    return hypothesis;
  }
  body_model::BodyPose Turned() const {
    body_model::BodyPose pose = truth_;
    pose.frame_from_root.rotation =
        pose.frame_from_root.rotation * Eigen::Quaterniond(0.0, 0.0, 0.0, 1.0);
    return pose;
  }
  FollowedPerson Follow(std::vector<Hypothesis> starts) {
    return {FollowSettings{}, person_, maker_.plan(), std::move(starts)};
  }
  void Show(FollowedPerson& person, const test::Picture& picture) {
    view_.Update(picture.camera, picture.depth_mm);
    person.Follow(view_, room_.Floor(), {&taken_}, kPeriod_s);
  }

  test::Room room_;
  BodyMaker maker_ = (test::ClothedBody(), BodyMaker("body_models/clothed_body.yaml"));
  PersonBody person_ = maker_.Make(1.75, 0.01);
  body_model::BodyPose truth_ = test::StandingIn(room_, person_.model, 0.0, 2.5);
  test::Picture picture_ = test::Look(room_, 160);
  test::Picture empty_ = test::Look(room_, 160);
  std::vector<std::uint8_t> taken_;
  DepthView view_;
};

TEST_F(FollowedPersonTest, TakesTheBestOfItsStarts) {
  auto person = Follow({At(Turned(), 0.5), At(truth_, 0.2)});
  EXPECT_EQ(person.best().mean_score, 0.2);
}

TEST_F(FollowedPersonTest, SettlesOnThePoseThatImagesSpeakFor) {
  auto person = Follow({At(Turned(), 0.2), At(truth_, 0.25)});
  EXPECT_FALSE(person.IsDoubtful()) << "while several are tried";
  for (int i = 0; i < 10; ++i) Show(person, picture_);
  const auto& root = person.best().pose.frame_from_root;
  EXPECT_LT(root.rotation.angularDistance(truth_.frame_from_root.rotation), 0.3);
  person.AddRivals({At(Turned(), 5.0)});
  Show(person, picture_);
  EXPECT_LT(person.best().mean_score, 0.4);
}

TEST_F(FollowedPersonTest, TurnsAboutOnlyForAPoseThatIsMuchBetter) {
  auto person = Follow({At(Turned(), 0.5)});
  person.AddRivals({At(truth_, 0.25)});
  EXPECT_TRUE(person.IsDoubtful()) << "no rival was taken";
  person.AddRivals({At(truth_, 0.1)});
  EXPECT_FALSE(person.IsDoubtful()) << "while several are tried";
}

TEST_F(FollowedPersonTest, StaysSomebodyAsLongAsAHeadIsSeen) {
  empty_.depth_mm.setTo(static_cast<int>(1000.0 * truth_.frame_from_root.translation_m.z() + 60));
  FollowSettings settings;
  settings.follow.lost_score = 10.0;
  FollowedPerson person(settings, person_, maker_.plan(), {At(truth_, 1.0)});
  for (int i = 0; i < 30; ++i) Show(person, empty_);
  person.SeeHead(true);
  EXPECT_FALSE(person.IsNobody());
  person.SeeHead(false);
  EXPECT_TRUE(person.IsNobody());
}

TEST_F(FollowedPersonTest, CountsTheTimeOutOfSightAndSaysThatHeIsLost) {
  auto person = Follow({At(truth_, 0.2)});
  person.id = 3;
  Show(person, picture_);
  EXPECT_EQ(person.unseen_s(), 0.0);
  EXPECT_EQ(person.Describe().state, body_model::BodyState::kTracked);
  Show(person, empty_);
  Show(person, empty_);
  EXPECT_NEAR(person.unseen_s(), 2.0 * kPeriod_s, 1e-9);
  const auto lost = person.Describe();
  EXPECT_EQ(lost.state, body_model::BodyState::kLost);
  for (const auto& limb : lost.limbs) EXPECT_EQ(limb.state, body_model::LimbState::kLost);
  Show(person, picture_);
  EXPECT_EQ(person.unseen_s(), 0.0);
}

TEST_F(FollowedPersonTest, IsNobodyWhoWasNeverExplainedWell) {
  // A wall just behind the body: nearly all of it is seen through.
  const double wall_m = truth_.frame_from_root.translation_m.z() + 0.06;
  empty_.depth_mm.setTo(static_cast<int>(1000.0 * wall_m));
  auto unproven = Follow({At(truth_, 1.0)});
  EXPECT_FALSE(unproven.IsNobody()) << "at once";
  for (int i = 0; i < 30; ++i) Show(unproven, empty_);
  EXPECT_TRUE(unproven.IsNobody());
}

TEST_F(FollowedPersonTest, StaysSomebodyWhoIsExplainedWell) {
  auto person = Follow({At(truth_, 0.2)});
  for (int i = 0; i < 30; ++i) Show(person, picture_);
  EXPECT_FALSE(person.IsNobody());
  EXPECT_FALSE(person.IsDoubtful());
}

TEST_F(FollowedPersonTest, DescribesItselfByTheModelThatItSends) {
  auto person = Follow({At(truth_, 0.2)});
  person.id = 3;
  Show(person, picture_);
  const auto body = person.Describe();
  const auto model = person.DescribeModel({77});
  EXPECT_EQ(body.model_id, model.body.id());
  EXPECT_EQ(model.person_id, 3);
  EXPECT_EQ(model.time.microseconds, 77);
  EXPECT_NEAR(model.stature_m, 1.75, 0.03);
  EXPECT_TRUE(body.covariance.allFinite());
  EXPECT_GT(body.covariance.diagonal().minCoeff(), 0.0);
}

}  // namespace
}  // namespace deixis::pose_fitter
