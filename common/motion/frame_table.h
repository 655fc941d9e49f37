#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "common/motion/skeleton.h"

namespace deixis::motion {

inline constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;

/// The names of ChannelKind in BVH files, in its order.
const std::string& ChannelName(ChannelKind kind);

/// What a file's numbers are to be multiplied with.
struct Scales {
  double metres = 1.0;
  double radians = 1.0;
};

struct Column {
  std::string name;  ///< "Hips Xrotation".
  double factor = 1.0;
};

/// The columns of the skeleton's frames.
std::vector<Column> ColumnsOf(const Skeleton& skeleton, const Scales& scales);

using FrameMatrix = decltype(Clip::frames);

/// Rows of frames that come one value after the other.
class FrameTable {
 public:
  explicit FrameTable(Eigen::Index columns) : columns_(columns) {}
  Eigen::Index columns() const { return columns_; }
  void Add(double value) { values_.push_back(value); }
  void Add(const std::vector<double>& row) {
    values_.insert(values_.end(), row.begin(), row.end());
  }
  FrameMatrix Matrix() const;  ///< Of the rows that are complete; needs at least one column.

 private:
  Eigen::Index columns_;
  std::vector<double> values_;
};

/// Throws MotionFileError about `path` unless a unit of length is from 1e-6 m to 1e6 m.
void RequireUnit(double metres_per_unit, const std::filesystem::path& path);

/// Throws MotionFileError about `path` unless a frame rate is from 1e-6 Hz to 1e6 Hz.
void RequireRate(double frame_rate_hz, const std::filesystem::path& path);

}  // namespace deixis::motion
