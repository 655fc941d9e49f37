#pragma once
#include <string>
#include <vector>

#include "common/geometry/rigid_transform.h"
#include "common/time/timestamp.h"

namespace deixis::geometry {

/// Where one frame of the robot is in another at a time; frames are told by their names.
struct FrameTransform {
  Timestamp time;      ///< At which it holds.
  std::string parent;  ///< Not empty.
  std::string child;   ///< Neither empty nor `parent`.
  RigidTransform parent_from_child;
};

/// What is said at once. The times need not be the same.
using FrameTransforms = std::vector<FrameTransform>;

}  // namespace deixis::geometry
