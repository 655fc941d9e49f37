#include "common/motion/frame_table.h"

#include <array>

#include "common/motion/motion_text.h"

namespace deixis::motion {

const std::string& ChannelName(ChannelKind kind) {
  static const std::array<std::string, 6> kNames = {"Xposition", "Yposition", "Zposition",
                                                    "Xrotation", "Yrotation", "Zrotation"};
  return kNames.at(static_cast<std::size_t>(kind));
}

std::vector<Column> ColumnsOf(const Skeleton& skeleton, const Scales& scales) {
  std::vector<Column> columns;
  for (const Joint& joint : skeleton.joints) {
    for (const ChannelKind kind : joint.channels) {
      columns.push_back({joint.name + " " + ChannelName(kind),
                         IsTranslation(kind) ? scales.metres : scales.radians});
    }
  }
  return columns;
}

FrameMatrix FrameTable::Matrix() const {
  const Eigen::Index rows = static_cast<Eigen::Index>(values_.size()) / columns_;
  return Eigen::Map<const FrameMatrix>(values_.data(), rows, columns_);
}

void RequireUnit(double metres_per_unit, const std::filesystem::path& path) {
  // The negation refuses NaN, too.
  if (!(metres_per_unit >= 1e-6 && metres_per_unit <= 1e6)) {
    throw MotionFileError(path.string() +
                          ": the unit of length must be from 1e-6 m to 1e6 m; give another");
  }
}

void RequireRate(double frame_rate_hz, const std::filesystem::path& path) {
  if (!(frame_rate_hz >= 1e-6 && frame_rate_hz <= 1e6)) {
    throw MotionFileError(path.string() +
                          ": the frame rate must be from 1e-6 Hz to 1e6 Hz; give another");
  }
}

}  // namespace deixis::motion
