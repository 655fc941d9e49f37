#include "services/pose_fitter/core/fitting/body_evidence.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "test/services/pose_fitter/synthetic_person.h"

namespace deixis::pose_fitter {
namespace {

constexpr double kGate_m = 0.12;

class BodyEvidenceTest : public ::testing::Test {
 protected:
  BodyEvidenceTest() { test::Draw(body_, pose_, 1, picture_); }
  void Gather(double gate_m = kGate_m) {
    view_.Update(picture_.camera, picture_.depth_mm);
    evidence_.Gather(view_, kinematics_, {&pose_}, room_.Floor(), {&taken_}, gate_m);
  }
  /// Pixels of the owner (0 = the room) that are the body's, and all that the owner has.
  std::pair<int, int> Share(int owner) const {
    std::pair<int, int> share{0, 0};
    for (int v = 0; v < picture_.owner.rows; ++v) {
      for (int u = 0; u < picture_.owner.cols; ++u) {
        if (picture_.owner.at<std::uint8_t>(v, u) != owner) continue;
        share.first += evidence_.IsBody(u, v);
        ++share.second;
      }
    }
    return share;
  }

  test::Room room_;
  body_model::BodyModel body_ = test::ClothedBody();
  body_model::BodyPose pose_ = test::StandingIn(room_, body_, 0.0, 2.5);
  body_model::Kinematics kinematics_{body_};
  test::Picture picture_ = test::Look(room_, 240);
  std::vector<std::uint8_t> taken_ = std::vector<std::uint8_t>(picture_.depth_mm.total(), 0);
  DepthView view_;
  BodyEvidence evidence_{BodyEvidenceConfig{}};
};

TEST_F(BodyEvidenceTest, TakesThePersonAndLeavesTheRoom) {
  Gather();
  const auto [person, all] = Share(1);
  EXPECT_GT(person, 0.95 * all);
  EXPECT_LT(Share(0).first, 0.05 * all);
}

TEST_F(BodyEvidenceTest, LeavesOutWhatIsBeyondTheGate) {
  picture_.depth_mm.forEach<std::uint16_t>(
      [](std::uint16_t& mm, const int*) { mm = static_cast<std::uint16_t>(mm - 500); });
  Gather();
  EXPECT_EQ(Share(1).first, 0);
}

TEST_F(BodyEvidenceTest, LeavesOutTheFloorAtTheFeet) {
  Gather(0.5);
  const auto floor = room_.Floor();
  for (int v = 0; v < view_.height_px(); ++v) {
    for (int u = 0; u < view_.width_px(); ++u) {
      if (!evidence_.IsBody(u, v)) continue;
      EXPECT_GT(floor.normal.dot(view_.Point(u, v)) + floor.offset_m, 0.04);
    }
  }
}

TEST_F(BodyEvidenceTest, LeavesOutWhatIsSomebodyElses) {
  std::fill(taken_.begin(), taken_.end(), std::uint8_t{1});
  Gather();
  EXPECT_EQ(evidence_.pixel_count(), 0);
  EXPECT_EQ(evidence_.points().count(), 0);
}

TEST_F(BodyEvidenceTest, LeavesOutIslands) {
  Gather();
  const Eigen::Vector3d head_m = kinematics_.proximal_m(body_.Find("head").value());
  const Eigen::Vector2d at = picture_.camera.Project(head_m);
  // All is far but a speck before the head.
  picture_.depth_mm.setTo(6000);
  const cv::Point speck(static_cast<int>(at.x()), static_cast<int>(at.y()));
  const auto near_mm = static_cast<int>(1000.0 * (head_m.z() - 0.1));
  picture_.depth_mm(cv::Rect(speck, cv::Size(2, 2))).setTo(near_mm);
  Gather();
  EXPECT_EQ(evidence_.pixel_count(), 0);
}

TEST_F(BodyEvidenceTest, SpreadsItsPointsOverTheBody) {
  Gather();
  EXPECT_NEAR(evidence_.points().count(), std::min(1500, evidence_.pixel_count()), 75);
  int in_blocks = 0;
  for (const PointBlock& block : evidence_.points().blocks) {
    for (int i = block.first; i < block.first + block.count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const auto& points = evidence_.points();
      const Eigen::Vector3f point_m(points.x_m[k], points.y_m[k], points.z_m[k]);
      EXPECT_LE((point_m - block.centre_m).norm(), block.radius_m + 1e-4F);
    }
    in_blocks += block.count;
  }
  EXPECT_EQ(in_blocks, evidence_.points().count());
}

TEST_F(BodyEvidenceTest, MeasuresHowFarBackgroundIsFromTheBody) {
  Gather();
  for (int v = 0; v < view_.height_px(); v += 7) {
    for (int u = 0; u < view_.width_px(); u += 7) {
      if (!evidence_.IsBody(u, v)) continue;
      EXPECT_EQ(evidence_.Clearance_px(u, v), 0.0F);
    }
  }
  EXPECT_GT(evidence_.Clearance_px(5, 5), 20.0F);
}

TEST_F(BodyEvidenceTest, IsEmptyBesideTheImage) {
  pose_.frame_from_root.translation_m.x() += 20.0;
  Gather();
  EXPECT_EQ(evidence_.points().count(), 0);
}

}  // namespace
}  // namespace deixis::pose_fitter
