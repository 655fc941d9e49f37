#pragma once
#include "common/geometry/rigid_transform.h"
#include "common/time/timestamp.h"

namespace deixis::geometry {

/// Where the robot holds its camera at a time: the raw one's optical frame, of two cameras the left
/// one's. The parent is the frame that the camera's calibration names as its mount
/// (`parent_frame`): the robot's base, say. What moves the camera says this; it goes before the
/// mount.
struct CameraPose {
  Timestamp time;                     ///< At which it holds.
  RigidTransform parent_from_camera;  ///< Camera optical frame in its parent, metres.
};

}  // namespace deixis::geometry
