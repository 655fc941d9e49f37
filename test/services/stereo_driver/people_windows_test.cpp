#include <gmock/gmock.h>

#include "services/stereo_driver/core/matching/people/said_people.h"
#include "services/stereo_driver/core/matching/people/windows.h"

namespace deixis::stereo_driver {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

const cv::Size kPicture(640, 480);

TEST(Windows, EndAtThePicturesBorderAndAtEvenPixels) {
  EXPECT_THAT(Tidied({{-20, 101, 63, 1000}}, kPicture, 1.0),
              ElementsAre(cv::Rect(0, 100, 44, 380)));
  EXPECT_THAT(Tidied({{-2000, -2000, 9000, 9000}}, kPicture, 1.0),
              ElementsAre(cv::Rect({0, 0}, kPicture)));
  EXPECT_THAT(Tidied({{0, 0, 99, 99}}, {33, 17}, 1.0), ElementsAre(cv::Rect(0, 0, 32, 16)));
}

TEST(Windows, ThatHaveNoRoomForAlignmentAreLeftOut) {
  EXPECT_THAT(Tidied({{700, 0, 50, 50}, {0, 0, 10, 200}, {0, 470, 300, 300}}, kPicture, 1.0),
              IsEmpty());
  EXPECT_THAT(Tidied({{0, 0, 99, 99}}, {12, 12}, 1.0), IsEmpty());
}

TEST(Windows, ThatOverlapBecomeOneOnlyWhenTheyFillIt) {
  EXPECT_THAT(Tidied({{0, 0, 100, 200}, {80, 0, 100, 200}}, kPicture, 1.0),
              ElementsAre(cv::Rect(0, 0, 180, 200)));
  EXPECT_THAT(Tidied({{0, 0, 100, 400}, {80, 0, 300, 100}}, kPicture, 1.0),
              ElementsAre(cv::Rect(0, 0, 100, 400), cv::Rect(100, 0, 280, 100)));
}

TEST(Windows, OfSeveralPeopleStayApart) {
  EXPECT_THAT(Tidied({{0, 0, 100, 400}, {300, 0, 100, 400}, {500, 0, 60, 60}}, kPicture, 1.0),
              SizeIs(3));
}

TEST(Windows, TakeNoMoreThanTheirShareTheFirstOnesFirst) {
  EXPECT_THAT(Tidied({{0, 0, 320, 240}, {320, 0, 320, 480}, {0, 240, 160, 240}}, kPicture, 0.4),
              ElementsAre(cv::Rect(0, 0, 320, 240), cv::Rect(0, 240, 160, 240)));
}

geometry::CameraCalibration Lens() {
  geometry::CameraCalibration lens;
  lens.width_px = kPicture.width;
  lens.height_px = kPicture.height;
  lens.focal_px = {500.0, 500.0};
  lens.principal_point_px = {320.0, 240.0};
  return lens;
}

body_model::LimbPose Limb(const Eigen::Vector3d& proximal_m, const Eigen::Vector3d& distal_m) {
  body_model::LimbPose limb;
  limb.proximal_m = proximal_m;
  limb.distal_m = distal_m;
  limb.state = body_model::LimbState::kMeasured;
  return limb;
}

/// Somebody of a metre, upright, at `place_m`.
body_model::TrackedBody Body(const Eigen::Vector3d& place_m) {
  const Eigen::Vector3d half_m(0.0, 0.5, 0.0);
  body_model::TrackedBody body;
  body.limbs = {Limb(place_m - half_m, place_m), Limb(place_m, place_m + half_m)};
  return body;
}

class SaidPeopleTest : public testing::Test {
 protected:
  SaidPeopleTest() {
    poses_.camera = poses_.frame = "STEREO";
    poses_.bodies = {Body({0.0, 0.0, 2.0})};
    config_.margin_m = 0.2;
    config_.speed_m_per_s = 1.0;
    config_.memory_s = 1.0;
  }
  Windows WindowsAt(std::int64_t microseconds) {
    SaidPeople people(config_, "STEREO");
    people.Hear(poses_);
    return people.At({microseconds}, Lens());
  }
  PeopleConfig config_;
  body_model::BodyPoses poses_;
};

TEST_F(SaidPeopleTest, AreWhereTheirLimbsAreSeenWithAMargin) {
  // 0.2 m are 50 px, 0.5 m are 125 px.
  EXPECT_THAT(WindowsAt(0), ElementsAre(cv::Rect(270, 65, 100, 350)));
}

TEST_F(SaidPeopleTest, MayHaveMovedTheMoreTheOlderTheirPosesAre) {
  EXPECT_THAT(WindowsAt(200'000), ElementsAre(cv::Rect(220, 15, 200, 450)));
}

TEST_F(SaidPeopleTest, AreForgottenAndSoAreThoseOfARecordingBefore) {
  EXPECT_THAT(WindowsAt(1'000'000), SizeIs(1));
  EXPECT_THAT(WindowsAt(1'000'001), IsEmpty());
  poses_.time = {5'000'000};
  EXPECT_THAT(WindowsAt(0), IsEmpty());
}

TEST_F(SaidPeopleTest, AreSeveral) {
  poses_.bodies = {Body({-1.0, 0.0, 3.0}), Body({1.0, 0.0, 3.0})};
  EXPECT_THAT(WindowsAt(0), SizeIs(2));
}

TEST_F(SaidPeopleTest, OutOfTheCamerasSightMakeNoWindow) {
  for (const Eigen::Vector3d& place_m :
       {Eigen::Vector3d(50.0, 0.0, 2.0), Eigen::Vector3d(-1e300, 1e300, 2.0),
        Eigen::Vector3d(0.0, 0.0, -2.0), Eigen::Vector3d(0.0, 0.0, 0.0)}) {
    poses_.bodies = {Body(place_m)};
    EXPECT_THAT(WindowsAt(0), IsEmpty()) << place_m.transpose();
  }
}

TEST_F(SaidPeopleTest, AreCutByThePicture) {
  poses_.bodies = {Body({1.2, 0.0, 2.0})};
  EXPECT_THAT(WindowsAt(0), ElementsAre(cv::Rect(570, 65, 70, 350)));
}

TEST_F(SaidPeopleTest, AreNotLookedForWhereALimbIsLost) {
  poses_.bodies[0].limbs[1].state = body_model::LimbState::kLost;
  EXPECT_THAT(WindowsAt(0), ElementsAre(cv::Rect(270, 65, 100, 225)));
  poses_.bodies[0].limbs[0].state = body_model::LimbState::kLost;
  EXPECT_THAT(WindowsAt(0), IsEmpty());
}

TEST_F(SaidPeopleTest, WhoHaveLeftMakeNoWindow) {
  SaidPeople people(config_, "STEREO");
  people.Hear(poses_);
  poses_.bodies.clear();
  people.Hear(poses_);
  EXPECT_THAT(people.At({0}, Lens()), IsEmpty());
}

TEST_F(SaidPeopleTest, InAnotherPictureOrFrameAreCountedAndChangeNothing) {
  SaidPeople people(config_, "STEREO");
  people.Hear(poses_);
  poses_.bodies.clear();
  for (auto* name : {&poses_.camera, &poses_.frame}) {
    *name = "CAMERA";
    people.Hear(poses_);
    *name = "STEREO";
  }
  EXPECT_EQ(people.elsewhere(), 2);
  EXPECT_THAT(people.At({0}, Lens()), SizeIs(1));
}

}  // namespace
}  // namespace deixis::stereo_driver
