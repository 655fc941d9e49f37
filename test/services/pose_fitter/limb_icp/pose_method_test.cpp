#include "services/pose_fitter/core/fitting/pose_method.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include "services/pose_fitter/core/bodies/followed_person.h"
#include "test/services/pose_fitter/synthetic_body.h"
#include "test/support/allocation_count.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;
using body_model::BodyPose;
using test::JointError_m;

/// A body and what is seen of it.
struct Scene {
  BodyModel model;
  BodyPose truth = test::Gesturing(model);
  test::BodyPicture picture;
  DepthView view;
  BodyEvidence evidence;

  Scene(const std::string& plan, int width_px, int points)
      : model(test::BodyOf(plan)),
        picture(test::Look(model, truth, width_px, 0.002)),
        evidence(BodyEvidenceConfig{0.12, 0.04, points, 0.3}) {
    view.Update(picture.camera, picture.depth_mm);
    body_model::Kinematics kinematics(model);
    evidence.Gather(view, kinematics, {&truth}, std::nullopt, {}, 0.12);
  }
};

class PoseMethodTest : public ::testing::TestWithParam<FitMethod> {
 protected:
  static FitSettings Settings() {
    FitSettings settings;
    settings.method = GetParam();
    return settings;
  }
};

TEST_P(PoseMethodTest, FindsABodyInADepthImage) {
  Scene scene("whole_body", 320, 4000);
  const auto method = MakePoseMethod(Settings(), scene.model);
  BodyPose pose = test::Disturbed(scene.model, scene.truth, 0.04);
  const BodyPose start = pose;
  const FitResult& result = method->Fit(scene.evidence, std::nullopt, start, std::nullopt, pose);
  EXPECT_LT(JointError_m(scene.model, scene.truth, pose), 0.025);
  EXPECT_GT(result.explained, 0.9);
  EXPECT_LT(result.score, 0.4);
  EXPECT_GT(result.trunk_seen, 0.8);
  EXPECT_EQ(method->winners().size(), static_cast<std::size_t>(scene.evidence.points().count()));
}

TEST_P(PoseMethodTest, FollowsAPersonAndSaysWhatItKnowsOfErrors) {
  Scene scene("upper_body", 240, 2000);
  FollowSettings settings;
  settings.fit = Settings();
  settings.follow.shape_frames = 0;
  const BodyMaker maker = test::MakerOf("upper_body");
  Hypothesis start;
  start.pose = test::Disturbed(scene.model, scene.truth, 0.03);
  start.rates_rad_per_s.setZero(scene.model.angle_count());
  FollowedPerson person(settings, maker.Make(1.75, 0.01), maker.plan(), {start});
  const std::vector<std::uint8_t> taken(scene.view.z_m().size(), 0);
  for (int i = 0; i < 3; ++i) person.Follow(scene.view, std::nullopt, {&taken}, 1.0 / 30.0);
  const body_model::TrackedBody body = person.Describe();
  EXPECT_LT(JointError_m(scene.model, scene.truth, body.pose), 0.025);
  const int size = GetParam() == FitMethod::kLimbIcp ? 0 : 6 + scene.model.angle_count();
  EXPECT_EQ(body.covariance.rows(), size);
  EXPECT_EQ(body.limbs.size(), static_cast<std::size_t>(scene.model.limb_count()));
}

INSTANTIATE_TEST_SUITE_P(All, PoseMethodTest,
                         ::testing::Values(FitMethod::kArticulated, FitMethod::kLimbIcp),
                         [](const auto& method) {
                           return method.param == FitMethod::kLimbIcp ? "LimbIcp" : "Articulated";
                         });

TEST(PoseMethodMemory, OfTheArticulatedFitStaysTheSame) {
  Scene scene("clothed_body", 64, 300);
  BodyFitterConfig config;
  config.iterations = 2;
  BodyFitter fitter(config, scene.model);
  BodyPose pose = scene.truth;
  for (int i = 0; i < 3; ++i) fitter.Fit(scene.evidence, std::nullopt, pose, 0.03, pose);
  const auto before = deixis::test::AllocatedBytes();
  const auto held = mallinfo2().uordblks;
  for (int i = 0; i < 10000; ++i) {
    pose = scene.truth;
    fitter.Fit(scene.evidence, std::nullopt, scene.truth, 0.03, pose);
  }
  EXPECT_EQ(deixis::test::AllocatedBytes() - before, 0U);
  EXPECT_EQ(mallinfo2().uordblks, held) << "Eigen takes its memory past `new`";
}

}  // namespace
}  // namespace deixis::pose_fitter
