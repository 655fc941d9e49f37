#include "services/viewer/core/body_overlay.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace deixis::viewer {
namespace {

using body_model::BodyState;
using body_model::LimbState;

const cv::Scalar kGround(60, 60, 60);

/// A person of one lower arm, which goes from the middle of the picture to the right, and is 0.5 m
/// long, 0.1 m thick and 2 m away.
class BodyOverlayTest : public testing::TestWithParam<cv::Size> {
 protected:
  void SetUp() override { Show({640, 480}); }

  void Show(cv::Size size) {
    scene_.image.bgr = cv::Mat(size, CV_8UC3, kGround);
    unit_ = size.height / 480.0;
    auto& camera = scene_.camera.emplace();
    camera.width_px = size.width;
    camera.height_px = size.height;
    camera.focal_px = Eigen::Vector2d::Constant(500.0 * unit_);
    camera.principal_point_px = {0.5 * size.width, 0.5 * size.height};
    scene_.models = {Model()};
    scene_.bodies.emplace().bodies = {Body()};
  }
  static body_model::PersonModel Model() {
    body_model::Limb limb;
    limb.name = "right_lower_arm";
    limb.shape = {0.1, 0.1, 0.1, 0.1, 0.5};
    return {{}, body_model::BodyModel("arm", {limb})};
  }
  static body_model::TrackedBody Body() {
    body_model::LimbPose limb;
    limb.frame_from_limb.rotation = Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitY());
    limb.frame_from_limb.translation_m = {0.0, 0.0, 2.0};
    limb.proximal_m = {0.0, 0.0, 2.0};
    limb.distal_m = {0.5, 0.0, 2.0};
    limb.state = LimbState::kMeasured;
    body_model::TrackedBody body;
    body.model_id = Model().body.id();
    body.state = BodyState::kTracked;
    body.limbs = {limb};
    return body;
  }
  body_model::TrackedBody& body() { return scene_.bodies->bodies[0]; }
  cv::Mat Drawn() const {
    Canvas canvas(scene_.image.bgr);
    DrawBodies(scene_, canvas);
    return canvas.picture();
  }
  int ChangedPixels(const cv::Rect2d& area) const {
    cv::Mat difference;
    cv::absdiff(Drawn(), scene_.image.bgr, difference);
    cv::cvtColor(difference, difference, cv::COLOR_BGR2GRAY);
    const cv::Rect scaled(cv::Point2d(area.tl() * unit_), cv::Point2d(area.br() * unit_));
    return cv::countNonZero(difference(scaled));
  }
  /// Within the arm, without its name above and the wrist at its end.
  const cv::Rect2d inside_{340, 225, 80, 30};
  const cv::Rect2d lower_edge_{330, 258, 100, 16};

  Scene scene_;
  double unit_ = 1.0;
};

TEST_P(BodyOverlayTest, FillsAMeasuredLimbWithinItsOutline) {
  Show(GetParam());
  EXPECT_EQ(ChangedPixels(inside_), static_cast<int>(80 * unit_) * static_cast<int>(30 * unit_));
  EXPECT_EQ(ChangedPixels({340, 280, 80, 100}), 0);
  EXPECT_EQ(ChangedPixels({100, 225, 180, 30}), 0);
}

INSTANTIATE_TEST_SUITE_P(Sizes, BodyOverlayTest,
                         testing::Values(cv::Size(640, 480), cv::Size(1280, 960)));

TEST_F(BodyOverlayTest, BreaksTheLineOfALimbThatIsGuessedOrHidden) {
  const int measured = ChangedPixels(lower_edge_);
  for (const LimbState state : {LimbState::kInferred, LimbState::kHidden}) {
    body().limbs[0].state = state;
    EXPECT_EQ(ChangedPixels(inside_), 0);
    EXPECT_GT(ChangedPixels(lower_edge_), 20);
    EXPECT_LT(ChangedPixels(lower_edge_), measured / 2);
  }
}

TEST_F(BodyOverlayTest, ShowsNoMoreThanARodOfALimbThatIsLost) {
  body().limbs[0].state = LimbState::kLost;
  EXPECT_EQ(ChangedPixels(lower_edge_), 0);
  EXPECT_GT(ChangedPixels(inside_), 20);
  body().limbs[0].state = LimbState::kMeasured;
  body().state = BodyState::kLost;
  EXPECT_EQ(ChangedPixels(lower_edge_), 0);
}

TEST_F(BodyOverlayTest, DrawsARodWhereTheModelIsNotKnown) {
  scene_.models.clear();
  EXPECT_EQ(ChangedPixels(lower_edge_), 0);
  EXPECT_GT(ChangedPixels(inside_), 20);
}

TEST_F(BodyOverlayTest, ShowsHowSureTheWristIs) {
  const cv::Rect2d beyond{460, 180, 80, 120};
  const int without = ChangedPixels(beyond);
  body().limbs[0].distal_covariance_m2 = 0.05 * 0.05 * Eigen::Matrix3d::Identity();
  EXPECT_GT(ChangedPixels(beyond), without + 40);
}

TEST_F(BodyOverlayTest, GivesPeopleColoursOfTheirOwn) {
  const cv::Vec3b first = Drawn().at<cv::Vec3b>(240, 380);
  body().person_id = 1;
  EXPECT_NE(Drawn().at<cv::Vec3b>(240, 380), first);
}

TEST_F(BodyOverlayTest, DrawsNearPeopleOverFarOnes) {
  body().pose.frame_from_root.translation_m.z() = 2.0;
  auto other = Body();
  other.person_id = 1;
  other.pose.frame_from_root.translation_m.z() = 3.0;
  scene_.bodies->bodies.push_back(other);
  const cv::Mat near_first = Drawn();
  std::swap(scene_.bodies->bodies[0], scene_.bodies->bodies[1]);
  EXPECT_EQ(cv::norm(near_first, Drawn(), cv::NORM_INF), 0.0);
}

TEST_F(BodyOverlayTest, DrawsNothingOfWhatLiesBehindTheCamera) {
  body().limbs[0].frame_from_limb.translation_m.z() = -2.0;
  EXPECT_EQ(ChangedPixels({0, 0, 640, 480}), 0);
}

TEST_F(BodyOverlayTest, CarriesOnWithAbsurdPlaces) {
  body().limbs[0].frame_from_limb.translation_m = {1e6, -1e6, 0.11};
  body().limbs[0].distal_covariance_m2 = 1e12 * Eigen::Matrix3d::Identity();
  for (const LimbState state : {LimbState::kMeasured, LimbState::kHidden, LimbState::kLost}) {
    body().limbs[0].state = state;
    EXPECT_EQ(Drawn().size(), scene_.image.bgr.size());
  }
}

TEST_F(BodyOverlayTest, BreaksTheLineOfALimbThatGoesOutOfThePicture) {
  body().limbs[0].state = LimbState::kHidden;
  body().limbs[0].frame_from_limb.translation_m.x() = 0.8;  // Its middle lies at the right border.
  EXPECT_GT(ChangedPixels({520, 258, 119, 16}), 20);
}

}  // namespace
}  // namespace deixis::viewer
