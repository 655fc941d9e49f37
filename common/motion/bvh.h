#pragma once
#include <Eigen/Core>
#include <array>
#include <filesystem>

#include "common/motion/motion_text.h"
#include "common/motion/skeleton.h"

namespace deixis::motion {

struct BvhOptions {
  /// BVH states no unit of length: centimetres unless the file's maker says another.
  double metres_per_unit = 0.01;
};

/// Reads a Biovision hierarchy file: several roots, 0 to 6 channels per joint in any order,
/// positions on any joint: they add to its offset, or, where they lie nearer to it than to zero,
/// take its place (programs differ). Joints keep the file's order. Throws MotionFileError.
Clip ReadBvh(const std::filesystem::path& path, const BvhOptions& options = {});

/// Angles about Z, X and Y, radians, whose product Rz Rx Ry is `rotation`, singular ones too.
std::array<double, 3> AnglesZxy(const Eigen::Matrix3d& rotation);

/// The same motion in what BVH can say: rotations of each joint by Z, X and Y, positions of roots
/// and of joints that have them, no pre- and rest rotations. Where there are positions the offset
/// is in them, so that readers who replace it agree with those who add to it.
Clip ToBvhChannels(const Clip& clip);

/// Writes the whole file or none, joints in depth-first order. Throws MotionFileError when it
/// cannot be written, std::logic_error when `clip` has what BVH cannot say: see ToBvhChannels.
void WriteBvh(const Clip& clip, const std::filesystem::path& path, const BvhOptions& options = {});

}  // namespace deixis::motion
