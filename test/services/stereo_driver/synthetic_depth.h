#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "services/stereo_driver/core/depth_camera/depth_registration.h"
#include "test/services/stereo_driver/synthetic_rig.h"

namespace deixis::stereo_driver {

/// An upright rectangle before a wall, in the colour camera's frame; metres.
struct Screen {
  double distance_m = 1.0;
  double left_m = -0.2, right_m = 0.2;
  double top_m = -0.15, bottom_m = 0.15;

  bool Covers(const Eigen::Vector3d& point) const {
    return point.x() >= left_m && point.x() <= right_m && point.y() >= top_m &&
           point.y() <= bottom_m;
  }
};

struct DepthScene {
  Plane wall;
  std::optional<Screen> screen;
};

/// A colour camera of 320x240 with distortion, and a depth camera of the same size but another
/// focal length and distortion, 25 mm to its right and turned by two degrees.
geometry::CameraCalibration ColourLens();
DepthView DepthBesideColour();

/// The pinhole that the colour camera has without its distortion, in pictures of `size`.
geometry::CameraCalibration Pinhole(cv::Size size);

/// What a camera measures of the scene: millimetres along its axis, rounded.
cv::Mat MeasureDepth(const geometry::CameraCalibration& lens,
                     const geometry::RigidTransform& colour_from_camera, const DepthScene& scene);
cv::Mat MeasureDepth(const DepthView& view, const DepthScene& scene);

/// 255 where the point of the scene that `pinhole` sees, in the colour camera's place, is hidden
/// from the depth camera by the screen.
cv::Mat HiddenFromDepth(const geometry::CameraCalibration& pinhole, const DepthView& view,
                        const DepthScene& scene);

/// stereo_calib's files of both, the colour camera first; without image size.
std::string ColourAndDepthIntrinsics();
std::string ColourAndDepthExtrinsics(double unit_m = 1.0);

}  // namespace deixis::stereo_driver
