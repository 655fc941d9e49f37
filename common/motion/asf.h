#pragma once
#include <filesystem>
#include <vector>

#include "common/motion/motion_text.h"
#include "common/motion/skeleton.h"

namespace deixis::motion {

/// An Acclaim skeleton and what is needed to read motions of it.
struct Asf {
  /// Joints in the hierarchy's depth-first order, the root first, under the names of their bones: a
  /// joint is where its bone begins. Bones without children end in an end site.
  Skeleton skeleton;
  /// Of each joint: the columns of a frame that its numbers in an AMC file fill, in their order.
  std::vector<std::vector<Eigen::Index>> columns;
  double metres_per_unit = 0.0;
  double radians_per_unit = 0.0;  ///< Of a motion that does not say its own.
};

/// Reads an Acclaim skeleton file (units, root, bonedata, hierarchy; limits are checked and left).
/// A root's orientation is its rest rotation; a bone turns by C M C^-1, C and M in the order of its
/// `axis`: XYZ means Rz Ry Rx. Throws MotionFileError.
Asf ReadAsf(const std::filesystem::path& path);

}  // namespace deixis::motion
