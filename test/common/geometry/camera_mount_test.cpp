#include "common/geometry/camera_mount.h"

#include <gtest/gtest.h>

#include <cmath>

namespace deixis::geometry {
namespace {

using Eigen::Vector3d;

// Of a camera that looks ahead in a frame with x forward, y left, z up.
const Eigen::Quaterniond kLooksAhead(0.5, -0.5, 0.5, -0.5);

CameraMount OnTheHead() { return {"base_link", {kLooksAhead, {0.1, 0.0, 1.2}}}; }

/// Right camera 0.2 m to the right of the left one, not turned; the rectified left one is turned by
/// a quarter about its own y.
StereoCalibration Rig() {
  StereoCalibration rig;
  rig.right_from_left.translation_m = {-0.2, 0.0, 0.0};
  // rectified_from_left: x goes to -z, z to x.
  rig.left.rectification << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  return rig;
}

Vector3d InParent(const CameraCalibration& camera, const Vector3d& point_m) {
  return *camera.parent_from_camera * point_m;
}

void ExpectNear(const Vector3d& actual, const Vector3d& expected) {
  EXPECT_NEAR((actual - expected).norm(), 0.0, 1e-12) << actual.transpose();
}

TEST(CameraMount, CameraThatLooksAheadSeesWhatIsInFrontOfTheRobot) {
  const CameraCalibration camera = Mounted(CameraCalibration{}, OnTheHead());
  EXPECT_EQ(camera.parent_frame, "base_link");
  ExpectNear(InParent(camera, {0, 0, 2}), {2.1, 0.0, 1.2});    // ahead
  ExpectNear(InParent(camera, {1, 0, 0}), {0.1, -1.0, 1.2});   // to its right
  ExpectNear(InParent(camera, {0, 0.5, 0}), {0.1, 0.0, 0.7});  // below
}

TEST(CameraMount, RightCameraStandsToTheRightOfTheLeftOne) {
  const StereoCalibration rig = Mounted(Rig(), OnTheHead());
  EXPECT_EQ(rig.left.parent_frame, "base_link");
  EXPECT_EQ(rig.right.parent_frame, "base_link");
  ExpectNear(InParent(rig.left, Vector3d::Zero()), {0.1, 0.0, 1.2});
  ExpectNear(InParent(rig.right, Vector3d::Zero()), {0.1, -0.2, 1.2});
  ExpectNear(InParent(rig.right, {0, 0, 1}), {1.1, -0.2, 1.2});
}

TEST(CameraMount, RightCameraThatIsTurnedLooksWhereItIsTurnedTo) {
  StereoCalibration rig = Rig();
  // Turned to the left by a quarter: its x is the left camera's z, its z that one's -x.
  rig.right_from_left = {Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitY())),
                         {0.0, 0.0, 0.2}};
  rig = Mounted(rig, OnTheHead());
  ExpectNear(InParent(rig.right, Vector3d::Zero()), {0.1, -0.2, 1.2});
  ExpectNear(InParent(rig.right, {0, 0, 1}), {0.1, 0.8, 1.2});
}

TEST(CameraMount, RectifiedCameraStandsWhereTheLeftOneDoesAndIsTurnedBack) {
  const StereoCalibration rig = Mounted(Rig(), OnTheHead());
  EXPECT_EQ(rig.rectified.parent_frame, "base_link");
  ExpectNear(InParent(rig.rectified, Vector3d::Zero()), {0.1, 0.0, 1.2});
  // What the rectified camera has on its x is on the left camera's z: ahead.
  ExpectNear(InParent(rig.rectified, {2, 0, 0}), {2.1, 0.0, 1.2});
  // On its z: on the left camera's -x, to the left.
  ExpectNear(InParent(rig.rectified, {0, 0, 1}), {0.1, 1.0, 1.2});
}

TEST(CameraMount, EveryCameraOfARigPutsAPointToTheSamePlace) {
  const StereoCalibration rig = Mounted(Rig(), OnTheHead());
  const Vector3d in_left(0.3, -0.1, 1.7);
  const Vector3d in_parent = InParent(rig.left, in_left);
  ExpectNear(InParent(rig.right, rig.right_from_left * in_left), in_parent);
  ExpectNear(InParent(rig.rectified, rig.left.rectification * in_left), in_parent);
}

}  // namespace
}  // namespace deixis::geometry
