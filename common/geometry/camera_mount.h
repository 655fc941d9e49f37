#pragma once
#include <string>

#include "common/geometry/camera_calibration.h"
#include "common/geometry/rigid_transform.h"
#include "common/geometry/stereo_calibration.h"

namespace deixis::geometry {

/// Where a camera is built into the robot; of two cameras, the raw left one. A CameraPose, where
/// there is one, goes before it.
struct CameraMount {
  std::string parent_frame;           ///< A frame of the robot, by its name; not empty.
  RigidTransform parent_from_camera;  ///< Raw camera's optical frame in it, metres.
};

/// The calibration of a camera that is mounted so.
CameraCalibration Mounted(CameraCalibration calibration, const CameraMount& mount);

/// The same of two cameras, whose raw left one is mounted so: `right` and `rectified` follow from
/// how they stand to it.
StereoCalibration Mounted(StereoCalibration calibration, const CameraMount& mount);

}  // namespace deixis::geometry
