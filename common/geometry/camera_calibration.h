#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/rigid_transform.h"
#include "common/time/timestamp.h"

namespace deixis::geometry {

/// Lens model of a camera, by OpenCV's names and order of coefficients.
enum class DistortionModel { kNone, kPlumbBob, kRational, kFisheye };

/// Pinhole camera with lens distortion. Camera optical frame: x right, y down, z forward, metres;
/// pixels with the origin at the centre of the top-left pixel.
struct CameraCalibration {
  Timestamp time;                                             ///< Of the image that it goes with.
  std::string camera;                                         ///< Name of the image it describes.
  int width_px = 0;                                           ///< Image width.
  int height_px = 0;                                          ///< Image height.
  DistortionModel distortion_model = DistortionModel::kNone;  ///< Lens model.
  std::vector<double> distortion;                             ///< k1 k2 p1 p2 k3 ... as OpenCV.
  Eigen::Vector2d focal_px = Eigen::Vector2d::Zero();         ///< Focal lengths fx, fy.
  Eigen::Vector2d principal_point_px = Eigen::Vector2d::Zero();  ///< cx, cy.
  Eigen::Matrix3d rectification = Eigen::Matrix3d::Identity();   ///< rectified_from_camera.
  bool is_calibrated = false;  ///< False: guessed from the field of view.
  std::string parent_frame;    ///< Frame that the camera is mounted in; empty = not known.
  std::optional<RigidTransform> parent_from_camera;  ///< Its place there; nothing = not known.
};

/// A camera without distortion whose horizontal field of view is `horizontal_fov_rad`; marked as
/// not calibrated; its focal length stays in what lens_limits.h allows. Throws
/// std::invalid_argument on a size or an angle that no camera has.
CameraCalibration GuessCalibration(int width_px, int height_px, double horizontal_fov_rad);

/// The same camera for the same view in pictures of another size.
CameraCalibration Scaled(CameraCalibration calibration, int width_px, int height_px);

}  // namespace deixis::geometry
