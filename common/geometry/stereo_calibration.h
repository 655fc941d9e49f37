#pragma once
#include <string>

#include "common/geometry/camera_calibration.h"
#include "common/geometry/rigid_transform.h"

namespace deixis::geometry {

/// How two cameras see together, or what a depth camera measures with.
struct StereoCalibration {
  Timestamp time;           ///< Of the image that it goes with.
  std::string camera;       ///< Name of the published picture with depth.
  CameraCalibration left;   ///< The raw left camera, with its distortion and rectification.
  CameraCalibration right;  ///< The raw right camera; of a depth camera: equal to `left`.
  CameraCalibration
      rectified;  ///< Pinhole of the published LEFT picture, and, scaled, of its depth.
  RigidTransform right_from_left;  ///< Raw cameras; identity for a depth camera.
  double disparity_sigma_px =
      0.0;  ///< At full width: sigma_z = z^2 / (f b) * this; 0 = depth camera.
  double depth_sigma_m_at_1m = 0.0;  ///< Grows with the square of the distance; 0 = not known.
};

}  // namespace deixis::geometry
