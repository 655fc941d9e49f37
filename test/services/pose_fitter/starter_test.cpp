#include "services/pose_fitter/core/start/starter.h"

#include <gtest/gtest.h>

#include "common/body_model/kinematics.h"
#include "services/pose_fitter/core/depth/sound_depth.h"
#include "test/services/pose_fitter/synthetic_person.h"

namespace deixis::pose_fitter {
namespace {

class StarterTest : public ::testing::Test {
 protected:
  std::vector<Hypothesis> Find(const test::Picture& picture) {
    view_.Update(picture.camera, picture.depth_mm);
    const auto& regions = finder_.Find(view_, sound_.Find(view_), room_.Floor());
    if (regions.regions.empty()) return {};
    return starter_.Find(view_, regions, regions.regions[0], body_);
  }
  test::Picture WithPerson(const body_model::BodyPose& pose) {
    test::Picture picture = test::Look(room_, 240);
    test::Draw(body_, pose, 1, picture);
    return picture;
  }

  test::Room room_;
  body_model::BodyModel body_ = test::ClothedBody();
  DepthView view_;
  SoundDepth sound_{SoundDepthConfig{}};
  PeopleFinder finder_;
  Starter starter_{StarterConfig{}, BodyEvidenceConfig{}, BodyFitterConfig{}};
};

TEST_F(StarterTest, FindsTheRootOfSomebodyWhoStands) {
  const auto truth = test::StandingIn(room_, body_, 0.2, 2.6);
  const auto starts = Find(WithPerson(truth));
  ASSERT_FALSE(starts.empty());
  ASSERT_LE(starts.size(), 2U);
  const auto& found = starts[0].pose.frame_from_root;
  EXPECT_LT((found.translation_m - truth.frame_from_root.translation_m).norm(), 0.06);
  EXPECT_LT(found.rotation.angularDistance(truth.frame_from_root.rotation), 0.35);
  EXPECT_LE(starts[0].mean_score, StarterConfig{}.worst_score);
}

TEST_F(StarterTest, WearsTheBodyThatSuitsThePersonBest) {
  const body_model::BodyModel small = test::ClothedBody(1.65), tall = test::ClothedBody(1.85);
  for (const auto* truth : {&small, &tall}) {
    test::Picture picture = test::Look(room_, 240);
    test::Draw(*truth, test::StandingIn(room_, *truth, 0.0, 2.8), 1, picture);
    Find(picture);
    const auto& regions = finder_.regions();
    starter_.Begin(view_, regions, regions.regions[0], body_);
    Effort effort{1 << 30};
    starter_.Advance(view_, regions, effort);
    const auto starts = starter_.TakeFound();  // Good enough or not.
    ASSERT_FALSE(starts.empty());
    const auto in_small = starter_.Wear(view_, regions, starts, body_, small);
    const auto in_tall = starter_.Wear(view_, regions, starts, body_, tall);
    ASSERT_FALSE(in_small.empty());
    ASSERT_FALSE(in_tall.empty());
    EXPECT_EQ(in_small[0].mean_score < in_tall[0].mean_score, truth == &small);
  }
}

TEST_F(StarterTest, SeesNobodyWithoutAHeadWhereOneShouldBeInThePicture) {
  const auto truth = test::StandingIn(room_, body_, 0.0, 2.6);
  test::Picture picture = WithPerson(truth);
  ASSERT_FALSE(Find(picture).empty());
  const test::Picture room = test::Look(room_, 240);
  body_model::Kinematics kinematics(body_);
  kinematics.Update(truth);
  const auto neck_px = picture.camera.Project(kinematics.proximal_m(*body_.Find("neck")));
  const cv::Rect above(0, 0, 240, static_cast<int>(neck_px.y()));
  room.depth_mm(above).copyTo(picture.depth_mm(above));
  EXPECT_TRUE(Find(picture).empty());
}

TEST_F(StarterTest, FindsTheSameWhenItMayDoLittleInEachImage) {
  const test::Picture picture = WithPerson(test::StandingIn(room_, body_, 0.2, 2.6));
  const auto at_once = Find(picture);
  const auto& regions = finder_.regions();
  starter_.Begin(view_, regions, regions.regions[0], body_);
  int images = 0, most = 0;
  for (; starter_.IsBusy(); ++images) {
    Effort effort{20000};
    starter_.Advance(view_, regions, effort);
    most = std::max(most, 20000 - effort.left);
  }
  EXPECT_GT(images, 5);
  EXPECT_LT(most, 100000) << "no more than one pose beyond what is allowed";
  auto found = starter_.TakeFound();
  DropNobodies(found);
  ASSERT_EQ(found.size(), at_once.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].mean_score, at_once[i].mean_score);
    EXPECT_EQ(found[i].pose.angles_rad, at_once[i].pose.angles_rad);
  }
}

TEST_F(StarterTest, ScoresABoxWorseThanAPersonOrOffersNobody) {
  room_.Add(test::Box{{-0.4, 2.4, 0.0}, {0.4, 2.8, 1.7}});
  test::Picture picture = test::Look(room_, 240);
  view_.Update(picture.camera, picture.depth_mm);
  PeopleRegions regions;
  regions.floor = room_.Floor();
  regions.labels.assign(picture.depth_mm.total(), 0);
  PersonRegion region;
  region.label = 1;
  region.top_m = 1.7;
  for (int v = 0; v < view_.height_px(); ++v) {
    for (int u = 0; u < view_.width_px(); ++u) {
      const bool is_box = view_.z_m(u, v) > 0.0F && view_.z_m(u, v) < 2.7F &&
                          regions.floor->normal.dot(view_.Point(u, v)) + 1.2 > 0.1;
      if (!is_box) continue;
      regions.labels[static_cast<std::size_t>(v * view_.width_px() + u)] = 1;
      ++region.pixel_count;
      region.centroid_m += view_.Point(u, v);
      region.box_px |= cv::Rect(u, v, 1, 1);
    }
  }
  ASSERT_GT(region.pixel_count, 1000);
  region.centroid_m /= region.pixel_count;
  for (const Hypothesis& start : starter_.Find(view_, regions, region, body_)) {
    EXPECT_GT(start.mean_score, 0.3) << "a box looks like a person";
  }
}

TEST_F(StarterTest, ScoresSomebodyWhoTurnsHisBackWorse) {
  auto back = test::StandingIn(room_, body_, 0.0, 2.6);
  const double facing = FacingPenalty(StarterConfig{}, back);
  back.frame_from_root.rotation =
      back.frame_from_root.rotation * Eigen::Quaterniond(0.0, 0.0, 0.0, 1.0);
  EXPECT_GT(FacingPenalty(StarterConfig{}, back), facing + 0.5 * StarterConfig{}.facing_away);
}

}  // namespace
}  // namespace deixis::pose_fitter
