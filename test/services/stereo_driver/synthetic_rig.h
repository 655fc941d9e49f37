#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "common/geometry/stereo_calibration.h"
#include "common/images/stereo_pair.h"

namespace deixis::stereo_driver {

/// A textured plane n . X = distance in the raw left camera's frame.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double distance_m = 2.0;
  double DepthAlong(const Eigen::Vector3d& ray) const { return distance_m / normal.dot(ray); }
};

/// Two cameras of 320x240 with lens distortion, 0.12 m apart, the right one turned by two degrees;
/// not rectified.
geometry::StereoCalibration SyntheticRig();

/// The pixels' rays in the camera's own frame, z = 1; row by row.
std::vector<cv::Point2d> RaysOf(const geometry::CameraCalibration& lens);

/// What they see of `plane`.
images::StereoPair Photograph(const geometry::StereoCalibration& rig, const Plane& plane);

/// The distance of `plane` along the rectified axis, in metres, at a pixel of the rectified left
/// camera scaled to `size`.
double RectifiedDepth_m(const geometry::StereoCalibration& rectified, const Plane& plane,
                        cv::Size size, cv::Point pixel);

/// OpenCV's stereo_calib files of `rig`, T in units of `unit_m`.
std::string IntrinsicsText(const geometry::StereoCalibration& rig);
std::string ExtrinsicsText(const geometry::StereoCalibration& rig, double unit_m = 1.0);

/// A rectified pair, CV_8UC1: a square before a wall, with another texture each.
struct Layers {
  cv::Mat left, right;
  int wall_px = 8;                        ///< Disparity of the wall.
  int square_px = 24;                     ///< Disparity of the square.
  cv::Rect square = {120, 60, 100, 100};  ///< In the left picture.
  cv::Rect Hidden() const {               ///< What only the left camera sees of the wall.
    return {square.x - (square_px - wall_px), square.y, square_px - wall_px, square.height};
  }
};
Layers SquareBeforeWall();

}  // namespace deixis::stereo_driver
