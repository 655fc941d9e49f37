#include "services/viewer/core/limb_outline.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace deixis::viewer {
namespace {

geometry::CameraCalibration Camera(double share = 1.0) {
  geometry::CameraCalibration camera;
  camera.width_px = static_cast<int>(640 * share);
  camera.height_px = static_cast<int>(480 * share);
  camera.focal_px = {500.0 * share, 500.0 * share};
  camera.principal_point_px = {320.0 * share, 240.0 * share};
  return camera;
}

/// Of a limb that goes down, 2 m before the camera, 0.5 m long.
geometry::RigidTransform Downwards(double z_m = 2.0) {
  geometry::RigidTransform camera_from_limb;
  camera_from_limb.rotation = Eigen::AngleAxisd(-M_PI / 2.0, Eigen::Vector3d::UnitX());
  camera_from_limb.translation_m = {0.0, 0.0, z_m};
  return camera_from_limb;
}

const geometry::DegenerateCylinder kLimb{0.1, 0.06, 0.05, 0.03, 0.5};

Eigen::AlignedBox2d BoxOf(const std::vector<Eigen::Vector2d>& outline) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : outline) box.extend(corner);
  return box;
}

TEST(OutlineOf, CoversWhatTheLimbCovers) {
  const auto box = BoxOf(OutlineOf(kLimb, Downwards(), Camera()));
  // The ellipses turn their b along the view: their widest points lie at 2 m.
  EXPECT_NEAR(box.min().x(), 320.0 - 500.0 * 0.1 / 2.0, 0.5);
  EXPECT_NEAR(box.max().x(), 320.0 + 500.0 * 0.1 / 2.0, 0.5);
  EXPECT_NEAR(box.max().y(), 240.0 + 500.0 * 0.5 / (2.0 - 0.03), 0.5);
  EXPECT_NEAR(box.min().y(), 240.0, 0.5);
}

TEST(OutlineOf, GrowsWithThePicture) {
  const auto usual = BoxOf(OutlineOf(kLimb, Downwards(), Camera()));
  const auto twice = BoxOf(OutlineOf(kLimb, Downwards(), Camera(2.0)));
  EXPECT_NEAR(twice.sizes().y(), 2.0 * usual.sizes().y(), 0.01);
}

TEST(OutlineOf, IsEmptyBehindTheCamera) {
  EXPECT_TRUE(OutlineOf(kLimb, Downwards(-2.0), Camera()).empty());
}

TEST(OutlineOf, ShowsThePartOfALimbThatLiesBeforeTheCamera) {
  geometry::RigidTransform towards;  // Along the view, from behind the camera to 0.3 m before it.
  towards.translation_m = {0.0, 0.0, -0.2};
  const auto outline = OutlineOf(kLimb, towards, Camera());
  ASSERT_GE(outline.size(), 3u);
  for (const Eigen::Vector2d& corner : outline) EXPECT_LT(corner.norm(), 2000.0);
  EXPECT_GT(BoxOf(outline).sizes().x(), 2.0 * 500.0 * 0.05 / 0.3);
}

TEST(SpreadOf, IsTheEllipseOfNineOfTen) {
  const Eigen::Vector3d sigma_m(0.02, 0.01, 0.5);  // On the axis, depth is not seen.
  const Eigen::Matrix3d covariance = sigma_m.cwiseAbs2().asDiagonal();
  const auto box = BoxOf(SpreadOf({0.0, 0.0, 2.0}, covariance, Camera()));
  const double radii = std::sqrt(4.605);
  EXPECT_NEAR(box.sizes().x(), 2.0 * radii * 500.0 * 0.02 / 2.0, 0.1);
  EXPECT_NEAR(box.sizes().y(), 2.0 * radii * 500.0 * 0.01 / 2.0, 0.1);
  EXPECT_NEAR(box.center().x(), 320.0, 1e-6);
}

TEST(SpreadOf, IsEmptyWhereNothingIsKnownOrSeen) {
  EXPECT_TRUE(SpreadOf({0.0, 0.0, 2.0}, Eigen::Matrix3d::Zero(), Camera()).empty());
  EXPECT_TRUE(SpreadOf({0.0, 0.0, -2.0}, Eigen::Matrix3d::Identity(), Camera()).empty());
}

}  // namespace
}  // namespace deixis::viewer
