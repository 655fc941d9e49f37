#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "common/files/whole_file.h"
#include "common/motion/bvh.h"
#include "common/motion/frame_table.h"

namespace deixis::motion {
namespace {

namespace fs = std::filesystem;
using Kind = ChannelKind;

constexpr std::array kPositions = {Kind::kXTranslation, Kind::kYTranslation, Kind::kZTranslation};
constexpr std::array kRotations = {Kind::kZRotation, Kind::kXRotation, Kind::kYRotation};

bool Moves(const Joint& joint) {
  return joint.parent < 0 ||
         std::any_of(joint.channels.begin(), joint.channels.end(), IsTranslation);
}

Joint InBvhChannels(const Joint& joint) {
  Joint bvh;
  bvh.name = joint.name;
  bvh.parent = joint.parent;
  bvh.end_sites_m = joint.end_sites_m;
  if (Moves(joint)) {
    bvh.channels.assign(kPositions.begin(), kPositions.end());
  } else {
    bvh.offset_m = joint.offset_m;
  }
  bvh.channels.insert(bvh.channels.end(), kRotations.begin(), kRotations.end());
  return bvh;
}

/// Throws std::logic_error for what BVH cannot say.
void RequireBvh(const Clip& clip) {
  const auto require = [](bool holds, const std::string& fault) {
    if (!holds) throw std::logic_error("BVH cannot say this clip: " + fault);
  };
  require(!clip.skeleton.joints.empty() && clip.frames.rows() > 0, "it is empty");
  require(clip.frames.cols() == clip.skeleton.ChannelCount(), "its frames have other channels");
  for (std::size_t i = 0; i < clip.skeleton.joints.size(); ++i) {
    const Joint& joint = clip.skeleton.joints[i];
    const auto is_turned = [](const Eigen::Quaterniond& turn) { return turn.vec().norm() > 0.0; };
    require(joint.parent >= -1 && joint.parent < static_cast<int>(i),
            joint.name + " does not stand after its parent");
    require(!is_turned(joint.pre_rotation) && !is_turned(joint.rest_rotation),
            joint.name + " has a pre- or rest rotation");
    require(!joint.name.empty() && joint.name.find_first_of("{}\r\n") == std::string::npos,
            "a joint's name is '" + joint.name + "'");
  }
}

struct Node {
  int joint = 0;
  int depth = 0;
};

/// Joints as BVH nests them, each right after its parent's earlier children.
std::vector<Node> DepthFirst(const Skeleton& skeleton) {
  const int count = static_cast<int>(skeleton.joints.size());
  std::vector<std::vector<int>> children(skeleton.joints.size() + 1);  // Of -1 first.
  for (int i = count; i-- > 0;) {
    children[static_cast<std::size_t>(skeleton.joints[static_cast<std::size_t>(i)].parent + 1)]
        .push_back(i);
  }
  std::vector<Node> order, to_visit;
  const auto visit_below = [&](int joint, int depth) {
    for (const int child : children[static_cast<std::size_t>(joint + 1)]) {
      to_visit.push_back({child, depth});
    }
  };
  // Children are listed from the last, so that the first is on top.
  visit_below(-1, 0);
  while (!to_visit.empty()) {
    order.push_back(to_visit.back());
    to_visit.pop_back();
    visit_below(order.back().joint, order.back().depth + 1);
  }
  return order;
}

/// The text of a clip, in the shortest digits that give the same numbers again.
class BvhText {
 public:
  BvhText(const Clip& clip, const fs::path& path, double metres_per_unit)
      : clip_(clip), path_(path), metres_per_unit_(metres_per_unit) {}

  std::string Text() {
    const std::vector<Node> nodes = DepthFirst(clip_.skeleton);
    text_ = "HIERARCHY\n";
    AddHierarchy(nodes);
    text_ += "MOTION\nFrames: " + std::to_string(clip_.frames.rows()) + "\nFrame Time:";
    AddNumber(1.0 / clip_.frame_rate_hz);
    text_ += "\n";
    AddFrames(ColumnsIn(nodes));
    return std::move(text_);
  }

 private:
  void AddHierarchy(const std::vector<Node>& nodes) {
    int open = 0;
    for (const Node& node : nodes) {
      CloseBlocks(open, node.depth);
      AddJoint(clip_.skeleton.joints[static_cast<std::size_t>(node.joint)], node.depth);
      open = node.depth + 1;
    }
    CloseBlocks(open, 0);
  }

  void AddJoint(const Joint& joint, int depth) {
    AddLine(depth, (depth == 0 ? "ROOT " : "JOINT ") + joint.name);
    AddLine(depth, "{");
    AddOffset(depth + 1, joint.offset_m);
    std::string channels = "CHANNELS " + std::to_string(joint.channels.size());
    for (const ChannelKind kind : joint.channels) channels += " " + ChannelName(kind);
    AddLine(depth + 1, channels);
    for (const Eigen::Vector3d& end_m : joint.end_sites_m) {
      AddLine(depth + 1, "End Site");
      AddLine(depth + 1, "{");
      AddOffset(depth + 2, end_m);
      AddLine(depth + 1, "}");
    }
  }

  void CloseBlocks(int open, int depth) {
    while (open > depth) AddLine(--open, "}");
  }

  void AddOffset(int depth, const Eigen::Vector3d& offset_m) {
    text_ += std::string(static_cast<std::size_t>(depth), '\t') + "OFFSET";
    for (const double value : offset_m) AddNumber(value / metres_per_unit_);
    text_ += "\n";
  }

  void AddLine(int depth, const std::string& line) {
    text_ += std::string(static_cast<std::size_t>(depth), '\t') + line + "\n";
  }

  struct WrittenColumn {
    Eigen::Index index;
    double divisor;
  };

  /// The clip's columns in the order of the file.
  std::vector<WrittenColumn> ColumnsIn(const std::vector<Node>& nodes) const {
    std::vector<Eigen::Index> first;
    Eigen::Index next = 0;
    for (const Joint& joint : clip_.skeleton.joints) {
      first.push_back(next);
      next += static_cast<Eigen::Index>(joint.channels.size());
    }
    std::vector<WrittenColumn> columns;
    for (const Node& node : nodes) {
      Eigen::Index index = first[static_cast<std::size_t>(node.joint)];
      const Joint& joint = clip_.skeleton.joints[static_cast<std::size_t>(node.joint)];
      for (const ChannelKind kind : joint.channels) {
        columns.push_back({index++, IsTranslation(kind) ? metres_per_unit_ : kRadiansPerDegree});
      }
    }
    return columns;
  }

  void AddFrames(const std::vector<WrittenColumn>& columns) {
    for (Eigen::Index row = 0; row < clip_.frames.rows(); ++row) {
      const std::size_t begin = text_.size();
      for (const WrittenColumn& column : columns) {
        AddNumber(clip_.frames(row, column.index) / column.divisor);
      }
      if (text_.size() > begin) text_.erase(begin, 1);  // The blank before the first.
      text_ += "\n";
    }
  }

  void AddNumber(double value) {
    if (!(std::abs(value) <= kLargestNumber)) {
      throw MotionFileError(path_.string() +
                            ": is not written: the clip holds a number that is not finite, or "
                            "larger than 1e9 in the file's unit");
    }
    std::array<char, 32> digits;
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    text_ += ' ';
    if (error == std::errc()) text_.append(digits.data(), end);
  }

  const Clip& clip_;
  const fs::path& path_;
  double metres_per_unit_;
  std::string text_;
};

}  // namespace

// Where Z and Y turn about one axis any Z serves: X and Y are taken from what it leaves, so that
// the product is right.
std::array<double, 3> AnglesZxy(const Eigen::Matrix3d& rotation) {
  const double z_rad = std::atan2(-rotation(0, 1), rotation(1, 1));
  const Eigen::Matrix3d left =
      Eigen::AngleAxisd(-z_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix() * rotation;
  return {z_rad, std::atan2(left(2, 1), left(1, 1)), std::atan2(left(0, 2), left(0, 0))};
}

Clip ToBvhChannels(const Clip& clip) {
  Clip bvh;
  bvh.frame_rate_hz = clip.frame_rate_hz;
  for (const Joint& joint : clip.skeleton.joints) {
    bvh.skeleton.joints.push_back(InBvhChannels(joint));
  }
  bvh.frames.resize(clip.frames.rows(), bvh.skeleton.ChannelCount());
  for (Eigen::Index row = 0; row < clip.frames.rows(); ++row) {
    const double* from = clip.frames.row(row).data();
    double* to = bvh.frames.row(row).data();
    for (const Joint& joint : clip.skeleton.joints) {
      const Eigen::Isometry3d pose = ParentFromJoint(joint, from);
      from += joint.channels.size();
      if (Moves(joint)) to = std::copy_n(pose.translation().data(), 3, to);
      const std::array<double, 3> angles_rad = AnglesZxy(pose.linear());
      to = std::copy(angles_rad.begin(), angles_rad.end(), to);
    }
  }
  return bvh;
}

void WriteBvh(const Clip& clip, const fs::path& path, const BvhOptions& options) {
  RequireUnit(options.metres_per_unit, path);
  RequireRate(clip.frame_rate_hz, path);
  RequireBvh(clip);
  const std::string text = BvhText(clip, path, options.metres_per_unit).Text();
  try {
    files::WriteWhole(path, text);
  } catch (const files::FileError& error) {
    throw MotionFileError(error.what());
  }
}

}  // namespace deixis::motion
