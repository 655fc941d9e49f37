#include "services/pose_fitter/core/cues/seen_parts.h"

#include <gtest/gtest.h>

#include "test/services/pose_fitter/synthetic_body.h"

namespace deixis::pose_fitter {
namespace {

constexpr double kPublished_px = 640.0;  // Width of the picture; depth is half of it.

class SeenPartsTest : public ::testing::Test {
 protected:
  SeenPartsTest() {
    camera_.width_px = 320;
    camera_.height_px = 240;
    camera_.focal_px = {300.0, 300.0};
    camera_.centre_px = {159.5, 119.5};
    depth_mm_ = cv::Mat(240, 320, CV_16UC1, cv::Scalar(2000));
    view_.Update(camera_, depth_mm_);
  }
  scene::Hands HandsAt(std::int64_t microseconds, const Eigen::Vector2d& centre_px) const {
    scene::Hand hand;
    hand.centre_px = centre_px;
    hand.side = scene::Side::kLeft;
    hand.side_probability = 0.9;
    return {{microseconds}, "left", "left", {hand}};
  }
  const std::vector<PartCue>& At(std::int64_t microseconds) {
    return parts_.At({microseconds}, "left", {kPublished_px, 480.0}, view_);
  }
  Eigen::Vector2d PixelOf(const PartCue& cue) const {
    return (camera_.focal_px.array() * cue.ray.head<2>().array() + camera_.centre_px.array());
  }

  DepthCamera camera_;
  cv::Mat depth_mm_;
  DepthView view_;
  SeenParts parts_{SeenPartsConfig{}};
};

TEST_F(SeenPartsTest, ScalesPixelsOfThePictureToThoseOfTheDepth) {
  parts_.Update(HandsAt(0, {101.0, 201.0}));
  ASSERT_EQ(At(0).size(), 1U);
  EXPECT_NEAR(PixelOf(At(0)[0]).x(), 50.25, 1e-9);
  EXPECT_NEAR(PixelOf(At(0)[0]).y(), 100.25, 1e-9);
}

TEST_F(SeenPartsTest, MovesOnWhatWasSeenBeforeTheImageAndTrustsItLess) {
  scene::Hands hands = HandsAt(0, {100.5, 200.5});
  hands.hands[0].velocity_px_per_s = {600.0, 0.0};
  parts_.Update(hands);
  const PartCue now = At(0).at(0);
  const PartCue later = At(100'000).at(0);
  EXPECT_NEAR(PixelOf(later).x() - PixelOf(now).x(), 30.0, 1e-6);
  EXPECT_GT(later.sigma, now.sigma);
}

TEST_F(SeenPartsTest, DropsWhatIsTooOldFromTheFutureOrOfAnotherCamera) {
  parts_.Update(HandsAt(1'000'000, {100.0, 200.0}));
  EXPECT_EQ(At(1'000'000).size(), 1U);
  EXPECT_TRUE(At(1'300'000).empty());
  EXPECT_TRUE(At(900'000).empty());
  EXPECT_TRUE(parts_.At({1'000'000}, "right", {kPublished_px, 480.0}, view_).empty());
}

TEST_F(SeenPartsTest, MeasuresTheDistanceOfAHandThatIsBeforeSomething) {
  depth_mm_(cv::Rect(40, 90, 20, 20)).setTo(1200);
  view_.Update(camera_, depth_mm_);
  parts_.Update(HandsAt(0, {100.0, 200.0}));
  ASSERT_TRUE(At(0).at(0).distance_m.has_value());
  EXPECT_NEAR(*At(0).at(0).distance_m, 1.2, 1e-6);
  depth_mm_.setTo(0);
  view_.Update(camera_, depth_mm_);
  EXPECT_FALSE(At(0).at(0).distance_m.has_value());
}

TEST_F(SeenPartsTest, LeavesOutWhatIsBesideThePictureOrMayBeAnywhere) {
  for (const double x_px : {-1e300, -30.0, 700.0, 1e300}) {
    parts_.Update(HandsAt(0, {x_px, 200.0}));
    EXPECT_TRUE(At(0).empty()) << x_px;
  }
  scene::Hands hands = HandsAt(0, {100.0, 200.0});
  hands.hands[0].covariance(0, 0) = 1e300;
  parts_.Update(hands);
  EXPECT_TRUE(At(0).empty());
}

TEST_F(SeenPartsTest, TakesTheSideFromTheTracker) {
  parts_.Update(HandsAt(0, {100.0, 200.0}));
  EXPECT_NEAR(At(0).at(0).right_probability, 0.1, 1e-9);
}

TEST_F(SeenPartsTest, LeavesOutHandsThatAreOnlyGuessed) {
  for (const auto state : {scene::HandState::kPredicted, scene::HandState::kOccluded}) {
    scene::Hands hands = HandsAt(0, {100.0, 200.0});
    hands.hands[0].state = state;
    parts_.Update(hands);
    EXPECT_TRUE(At(0).empty());
  }
}

TEST_F(SeenPartsTest, TakesFacesThatAreSeenNow) {
  scene::Object face;
  face.kind = scene::ObjectKind::kFace;
  face.box = scene::Box{90.0, 190.0, 20.0, 20.0};
  scene::Objects objects{{0}, "left", "left", "test", {face}};
  parts_.Update(objects);
  ASSERT_EQ(At(0).size(), 1U);
  EXPECT_EQ(At(0)[0].part, Part::kFace);
  EXPECT_NEAR(PixelOf(At(0)[0]).x(), 49.75, 1e-9);
  objects.objects[0].visibility = scene::Visibility::kRemembered;
  parts_.Update(objects);
  EXPECT_TRUE(At(0).empty());
  objects.objects[0] = face;
  objects.objects[0].kind = scene::ObjectKind::kObject;
  parts_.Update(objects);
  EXPECT_TRUE(At(0).empty()) << "a thing is nobody's part";
}

}  // namespace
}  // namespace deixis::pose_fitter
