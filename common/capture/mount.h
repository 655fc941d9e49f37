#pragma once
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/geometry/camera_mount.h"

namespace deixis::capture {

/// Where the camera is built into the robot: the pose of its optical frame (x right, y down, z
/// forward; of two cameras, the raw left one's) in a frame of the robot.
struct MountConfig {
  std::string parent_frame;                               ///< By its name; empty = not known.
  std::vector<double> translation_m{0.0, 0.0, 0.0};       ///< The camera's place x y z there.
  std::vector<double> rotation_wxyz{1.0, 0.0, 0.0, 0.0};  ///< Unit quaternion parent_from_camera.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("parent_frame", parent_frame);
    v("translation_m", translation_m);
    v("rotation_wxyz", rotation_wxyz);
  }
  void Validate() const;    ///< Throws FaultsFound.
  bool IsIdentity() const;  ///< As it is when nobody has given a pose.
};

/// What a valid `config` says, the quaternion made of length 1; nothing when it names no frame.
std::optional<geometry::CameraMount> MountOf(const MountConfig& config);

}  // namespace deixis::capture
