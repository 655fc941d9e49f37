#pragma once
#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "common/motion/skeleton.h"

namespace deixis::motion {

/// Axes 0 to 2 in the order in which a file names them: "XYZ" is {0, 1, 2}.
using AxisOrder = std::array<int, 3>;

struct AsfRoot {
  std::vector<ChannelKind> order;  ///< As its numbers stand in an AMC file.
  AxisOrder axes{};
  Eigen::Vector3d position = Eigen::Vector3d::Zero();     ///< In the file's unit, as all lengths.
  Eigen::Vector3d orientation = Eigen::Vector3d::Zero();  ///< In the file's unit, as all angles.
};

struct AsfBone {
  std::string name;
  std::size_t line = 0;  ///< Of its name.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  double length = 0.0;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  AxisOrder axes{};
  std::vector<ChannelKind> dof;  ///< As its numbers stand in an AMC file; rotations only.
  std::vector<int> children;     ///< Indices of bones, in the file's order.
};

/// What an ASF file says, before it is made a skeleton. Its bones hang below its root, each once.
struct AsfText {
  double metres_per_unit = 0.0;
  double radians_per_unit = 0.0;
  AsfRoot root;
  std::vector<AsfBone> bones;
  std::vector<int> root_children;
};

/// Throws MotionFileError.
AsfText ReadAsfText(const std::filesystem::path& path);

}  // namespace deixis::motion
