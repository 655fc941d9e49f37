#include "common/motion/asf.h"

#include <algorithm>

#include "common/motion/asf_text.h"

namespace deixis::motion {
namespace {

using Eigen::Vector3d;

/// "XYZ" means Rz Ry Rx.
Eigen::Quaterniond Rotation(const Vector3d& angles_rad, const AxisOrder& axes) {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  for (std::size_t i = 0; i < axes.size(); ++i) {
    rotation =
        Eigen::AngleAxisd(angles_rad[static_cast<Eigen::Index>(i)], Vector3d::Unit(axes[i])) *
        rotation;
  }
  return rotation;
}

/// Translations as they stand in the file, then rotations so that the last axis is leftmost.
std::vector<ChannelKind> InProductOrder(const std::vector<ChannelKind>& in_file,
                                        const AxisOrder& axes) {
  std::vector<ChannelKind> channels;
  std::copy_if(in_file.begin(), in_file.end(), std::back_inserter(channels), IsTranslation);
  for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) {
    const auto kind = static_cast<ChannelKind>(static_cast<int>(ChannelKind::kXRotation) + *axis);
    if (std::count(in_file.begin(), in_file.end(), kind) != 0) channels.push_back(kind);
  }
  return channels;
}

class SkeletonBuilder {
 public:
  explicit SkeletonBuilder(const AsfText& text) : text_(text) {
    asf_.metres_per_unit = text.metres_per_unit;
    asf_.radians_per_unit = text.radians_per_unit;
  }

  Asf Build() {
    AddRoot();
    std::vector<ToPlace> to_place;
    const auto add_below = [&to_place](const std::vector<int>& children, const ToPlace& place) {
      for (auto child = children.rbegin(); child != children.rend(); ++child) {
        to_place.push_back({*child, place.parent, place.offset_m});
      }
    };
    add_below(text_.root_children, {0, 0, Vector3d::Zero()});
    while (!to_place.empty()) {
      const ToPlace place = to_place.back();
      to_place.pop_back();
      const AsfBone& bone = text_.bones[static_cast<std::size_t>(place.bone)];
      add_below(bone.children, AddBone(bone, place));
    }
    return std::move(asf_);
  }

 private:
  struct ToPlace {
    int bone = 0;
    int parent = 0;     ///< A joint.
    Vector3d offset_m;  ///< Where the parent's bone ends.
  };

  void AddRoot() {
    Joint joint;
    joint.name = "root";
    joint.offset_m = text_.metres_per_unit * text_.root.position;
    joint.rest_rotation = Turn(text_.root.orientation, text_.root.axes);
    Add(std::move(joint), text_.root.order, text_.root.axes);
  }

  /// The place of the bone's children.
  ToPlace AddBone(const AsfBone& bone, const ToPlace& place) {
    const Vector3d end_m = text_.metres_per_unit * bone.length * bone.direction;
    Joint joint;
    joint.name = bone.name;
    joint.parent = place.parent;
    joint.offset_m = place.offset_m;
    joint.pre_rotation = Turn(bone.axis, bone.axes);
    if (bone.children.empty()) joint.end_sites_m = {end_m};
    Add(std::move(joint), bone.dof, bone.axes);
    return {0, static_cast<int>(asf_.skeleton.joints.size()) - 1, end_m};
  }

  Eigen::Quaterniond Turn(const Vector3d& xyz, const AxisOrder& axes) const {
    // A file gives the angles about X, Y and Z, whatever the order.
    Vector3d angles_rad;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      angles_rad[static_cast<Eigen::Index>(i)] = text_.radians_per_unit * xyz[axes[i]];
    }
    return Rotation(angles_rad, axes);
  }

  void Add(Joint joint, const std::vector<ChannelKind>& in_file, const AxisOrder& axes) {
    joint.channels = InProductOrder(in_file, axes);
    std::vector<Eigen::Index> columns;
    for (const ChannelKind kind : in_file) {
      const auto found = std::find(joint.channels.begin(), joint.channels.end(), kind);
      columns.push_back(channel_count_ + (found - joint.channels.begin()));
    }
    channel_count_ += static_cast<Eigen::Index>(joint.channels.size());
    asf_.columns.push_back(std::move(columns));
    asf_.skeleton.joints.push_back(std::move(joint));
  }

  const AsfText& text_;
  Asf asf_;
  Eigen::Index channel_count_ = 0;
};

}  // namespace

Asf ReadAsf(const std::filesystem::path& path) {
  return SkeletonBuilder(ReadAsfText(path)).Build();
}

}  // namespace deixis::motion
