#include "services/viewer/core/overlay.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>

namespace deixis::viewer {
namespace {

const cv::Scalar kGround(60, 60, 60);

class OverlayTest : public testing::Test {
 protected:
  explicit OverlayTest(cv::Size size = {640, 480}) {
    scene_.image.bgr = cv::Mat(size, CV_8UC3, kGround);
  }
  void AddObject(int id, const scene::Box& box) {
    scene::Object object;
    object.id = id;
    object.label = "lamp";
    object.kind = scene::ObjectKind::kPlace;
    object.box = box;
    if (!scene_.objects) scene_.objects.emplace();
    scene_.objects->objects.push_back(object);
  }
  scene::Hand& AddHand(double x_px, double y_px) {
    scene::Hand hand;
    hand.id = 3;
    hand.side = scene::Side::kRight;
    hand.centre_px = {x_px, y_px};
    if (!scene_.hands) scene_.hands.emplace();
    scene_.hands->hands.push_back(hand);
    return scene_.hands->hands.back();
  }
  void Decide(scene::GestureOutcome outcome) {
    scene::Gesture gesture;
    gesture.name = "pointing";
    gesture.outcome = outcome;
    gesture.object_id = 7;
    gesture.object_label = "lamp";
    gesture.candidates = {{7, "lamp", 0.934}, {8, "cup", 0.05}};
    scene_.decision = gesture;
  }
  cv::Mat Changed() const {
    cv::Mat difference;
    cv::absdiff(DrawOverlay(scene_), scene_.image.bgr, difference);
    cv::cvtColor(difference, difference, cv::COLOR_BGR2GRAY);
    return difference > 0;
  }
  bool IsChangedAt(int x, int y) const { return Changed().at<std::uint8_t>(y, x) != 0; }
  int ChangedPixels(const cv::Rect& area) const { return cv::countNonZero(Changed()(area)); }

  Scene scene_;
};

TEST_F(OverlayTest, LeavesAPictureWithoutResultsAsItIs) {
  EXPECT_EQ(cv::countNonZero(Changed()), 0);
}

TEST_F(OverlayTest, DoesNotDrawIntoThePictureThatItIsGiven) {
  AddObject(7, {200, 150, 100, 80});
  const cv::Mat before = scene_.image.bgr.clone();
  DrawOverlay(scene_);
  EXPECT_EQ(cv::norm(before, scene_.image.bgr, cv::NORM_INF), 0.0);
}

TEST_F(OverlayTest, DrawsAnObjectsOutlineAndItsLabelAbove) {
  AddObject(7, {200, 150, 100, 80});
  EXPECT_TRUE(IsChangedAt(250, 150));
  EXPECT_TRUE(IsChangedAt(200, 190));
  EXPECT_FALSE(IsChangedAt(250, 190));
  EXPECT_GT(ChangedPixels({200, 125, 40, 24}), 100);
}

TEST_F(OverlayTest, DrawsTheMeantObjectStronger) {
  AddObject(7, {200, 150, 100, 80});
  const int usual = ChangedPixels({190, 180, 120, 60});
  Decide(scene::GestureOutcome::kObject);
  EXPECT_GT(ChangedPixels({190, 180, 120, 60}), usual);
}

TEST_F(OverlayTest, BreaksTheOutlineOfAFaceThatIsNotSeen) {
  AddObject(7, {200, 150, 100, 80});
  scene_.objects->objects[0].kind = scene::ObjectKind::kFace;
  const int seen = ChangedPixels({190, 160, 20, 60});
  scene_.objects->objects[0].visibility = scene::Visibility::kOccluded;
  const int hidden = ChangedPixels({190, 160, 20, 60});
  EXPECT_LT(hidden, seen);
  EXPECT_GT(hidden, seen / 4);
}

TEST_F(OverlayTest, DrawsAHandsCircleAndTheWayItMoves) {
  scene::Hand& hand = AddHand(300, 200);
  hand.box = {280, 180, 40, 40};
  EXPECT_TRUE(IsChangedAt(320, 200));
  EXPECT_FALSE(IsChangedAt(350, 200));
  hand.velocity_px_per_s = {240, 0};  // 60 px in a quarter of a second.
  EXPECT_TRUE(IsChangedAt(345, 200));
}

TEST_F(OverlayTest, PutsASecondRingAroundTheActingHand) {
  AddHand(300, 200).box = {280, 180, 40, 40};
  EXPECT_FALSE(IsChangedAt(300, 175));
  scene_.hands->hands[0].is_acting = true;
  EXPECT_TRUE(IsChangedAt(300, 175));
}

TEST_F(OverlayTest, TintsTheSectorWhereObjectsAreLookedFor) {
  scene::GestureHypothesis hypothesis;
  hypothesis.side = scene::Side::kRight;
  hypothesis.context = scene::ContextArea{{300, 240}, 100, -0.5, 0.5};
  scene_.state.emplace().hypotheses.push_back(hypothesis);
  EXPECT_TRUE(IsChangedAt(360, 240));
  EXPECT_FALSE(IsChangedAt(240, 240));
  EXPECT_FALSE(IsChangedAt(300, 160));
}

TEST_F(OverlayTest, SaysTheDecisionInLargeLettersAtTheBottom) {
  Decide(scene::GestureOutcome::kObject);
  EXPECT_GT(ChangedPixels({120, 420, 400, 60}), 10'000);
  EXPECT_EQ(ChangedPixels({0, 0, 640, 300}), 0);
}

TEST_F(OverlayTest, CarriesOnWithWhatLiesFarOutside) {
  AddObject(7, {-1e9, -1e12, 3e12, 1e15});
  AddHand(1e7, -1e7).velocity_px_per_s = {1e9, 1e9};
  scene::GestureHypothesis hypothesis;
  hypothesis.context = scene::ContextArea{{1e9, 1e9}, 1e9, 0.0, 1.0};
  scene_.state.emplace().hypotheses.push_back(hypothesis);
  EXPECT_EQ(DrawOverlay(scene_).size(), scene_.image.bgr.size());
}

class AnySizeTest : public OverlayTest, public testing::WithParamInterface<cv::Size> {
 protected:
  AnySizeTest() : OverlayTest(GetParam()) {}
};

TEST_P(AnySizeTest, KeepsTheShareOfThePictureThatLettersTake) {
  Decide(scene::GestureOutcome::kObject);
  const cv::Size size = GetParam();
  const cv::Rect text = cv::boundingRect(Changed());
  EXPECT_GT(text.height, 0.06 * size.height);
  EXPECT_LT(text.height, 0.16 * size.height);
  EXPECT_LE(text.width, size.width);
}

INSTANTIATE_TEST_SUITE_P(Sizes, AnySizeTest,
                         testing::Values(cv::Size(320, 240), cv::Size(640, 480),
                                         cv::Size(1280, 720), cv::Size(1920, 1080)));

TEST(Overlay, CarriesOnWithATinyPicture) {
  Scene scene;
  scene.image.bgr = cv::Mat(1, 1, CV_8UC3, kGround);
  scene.decision.emplace().name = "pointing";
  EXPECT_EQ(DrawOverlay(scene).size(), cv::Size(1, 1));
}

TEST(DecisionText, NamesTheObjectAndItsProbability) {
  scene::Gesture gesture;
  gesture.name = "pointing";
  gesture.outcome = scene::GestureOutcome::kObject;
  gesture.object_id = 7;
  gesture.object_label = "lamp";
  gesture.candidates = {{7, "lamp", 0.934}};
  EXPECT_EQ(DecisionText(gesture), "pointing at: lamp 0.93");
}

TEST(DecisionText, SaysWhenNothingOrMoreThanOneThingMayBeMeant) {
  scene::Gesture gesture;
  gesture.name = "pointing";
  gesture.outcome = scene::GestureOutcome::kNoObject;
  EXPECT_EQ(DecisionText(gesture), "pointing at nothing known");
  gesture.outcome = scene::GestureOutcome::kAmbiguous;
  gesture.candidates = {{7, "lamp", 0.5}, {8, "cup", 0.45}};
  EXPECT_EQ(DecisionText(gesture), "pointing at: lamp 0.50 or cup 0.45?");
}

}  // namespace
}  // namespace deixis::viewer
