#include "test/services/stereo_driver/synthetic_depth.h"

#include <cmath>
#include <limits>

namespace deixis::stereo_driver {
namespace {

geometry::StereoCalibration ColourAndDepth() {
  geometry::StereoCalibration pair;
  pair.left = ColourLens();
  const DepthView depth = DepthBesideColour();
  pair.right = depth.lens;
  pair.right_from_left = geometry::Inverse(depth.colour_from_depth);
  return pair;
}

/// Multiples of `way` from `start` to the wall, and to the screen; infinite when it meets none.
double WayToWall(const Plane& wall, const Eigen::Vector3d& start, const Eigen::Vector3d& way) {
  const double steps = (wall.distance_m - wall.normal.dot(start)) / wall.normal.dot(way);
  return steps > 0.0 ? steps : std::numeric_limits<double>::infinity();
}

double WayToScreen(const std::optional<Screen>& screen, const Eigen::Vector3d& start,
                   const Eigen::Vector3d& way) {
  if (!screen) return std::numeric_limits<double>::infinity();
  const double steps = (screen->distance_m - start.z()) / way.z();
  const bool meets = steps > 0.0 && screen->Covers(start + steps * way);
  return meets ? steps : std::numeric_limits<double>::infinity();
}

double WayToScene(const DepthScene& scene, const Eigen::Vector3d& start,
                  const Eigen::Vector3d& way) {
  return std::min(WayToWall(scene.wall, start, way), WayToScreen(scene.screen, start, way));
}

}  // namespace

geometry::CameraCalibration ColourLens() { return SyntheticRig().left; }

DepthView DepthBesideColour() {
  DepthView view;
  view.lens = SyntheticRig().right;
  view.lens.focal_px = {305.0, 304.0};
  view.lens.distortion = {-0.12, 0.05, -0.0006, 0.0003, 0.0};
  const Eigen::Vector3d axis = Eigen::Vector3d(0.3, 1.0, 0.2).normalized();
  view.colour_from_depth.rotation = Eigen::AngleAxisd(2.0 * M_PI / 180.0, axis);
  view.colour_from_depth.translation_m = {0.025, 0.001, -0.002};
  return view;
}

geometry::CameraCalibration Pinhole(cv::Size size) {
  geometry::CameraCalibration pinhole = ColourLens();
  pinhole.distortion_model = geometry::DistortionModel::kNone;
  pinhole.distortion.clear();
  return geometry::Scaled(pinhole, size.width, size.height);
}

cv::Mat MeasureDepth(const geometry::CameraCalibration& lens,
                     const geometry::RigidTransform& colour_from_camera, const DepthScene& scene) {
  cv::Mat depth_mm(lens.height_px, lens.width_px, CV_16UC1);
  const std::vector<cv::Point2d> rays = RaysOf(lens);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector3d way =
        colour_from_camera.rotation * Eigen::Vector3d(rays[i].x, rays[i].y, 1.0);
    // Rays are of z = 1, so the way's length is the distance along the axis.
    const double z_m = WayToScene(scene, colour_from_camera.translation_m, way);
    depth_mm.at<std::uint16_t>(static_cast<int>(i)) =
        static_cast<std::uint16_t>(z_m < 65.0 ? std::lround(z_m * 1000.0) : 0);
  }
  return depth_mm;
}

cv::Mat MeasureDepth(const DepthView& view, const DepthScene& scene) {
  return MeasureDepth(view.lens, view.colour_from_depth, scene);
}

cv::Mat HiddenFromDepth(const geometry::CameraCalibration& pinhole, const DepthView& view,
                        const DepthScene& scene) {
  cv::Mat hidden(pinhole.height_px, pinhole.width_px, CV_8UC1);
  const std::vector<cv::Point2d> rays = RaysOf(pinhole);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector3d way(rays[i].x, rays[i].y, 1.0);
    const Eigen::Vector3d point = way * WayToScene(scene, Eigen::Vector3d::Zero(), way);
    const Eigen::Vector3d eye = view.colour_from_depth.translation_m;
    const bool is_hidden = WayToScreen(scene.screen, eye, point - eye) < 1.0 - 1e-6;
    hidden.at<std::uint8_t>(static_cast<int>(i)) = is_hidden ? 255 : 0;
  }
  return hidden;
}

std::string ColourAndDepthIntrinsics() { return IntrinsicsText(ColourAndDepth()); }
std::string ColourAndDepthExtrinsics(double unit_m) {
  return ExtrinsicsText(ColourAndDepth(), unit_m);
}

}  // namespace deixis::stereo_driver
