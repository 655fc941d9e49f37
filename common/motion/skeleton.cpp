#include "common/motion/skeleton.h"

#include <stdexcept>

namespace deixis::motion {
namespace {

Eigen::Vector3d Axis(ChannelKind kind) {
  return Eigen::Vector3d::Unit(static_cast<Eigen::Index>(kind) % 3);
}

}  // namespace

bool IsTranslation(ChannelKind kind) { return kind <= ChannelKind::kZTranslation; }

Eigen::Isometry3d ParentFromJoint(const Joint& joint, const double* values) {
  Eigen::Vector3d offset_m = joint.offset_m;
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  for (const ChannelKind kind : joint.channels) {
    const double value = *values++;
    if (IsTranslation(kind)) {
      offset_m += value * Axis(kind);
    } else {
      turn = turn * Eigen::AngleAxisd(value, Axis(kind));
    }
  }
  return Eigen::Translation3d(offset_m) *
         (joint.rest_rotation * joint.pre_rotation * turn * joint.pre_rotation.conjugate());
}

Eigen::Index Skeleton::ChannelCount() const {
  std::size_t count = 0;
  for (const Joint& joint : joints) count += joint.channels.size();
  return static_cast<Eigen::Index>(count);
}

std::vector<Eigen::Isometry3d> ForwardKinematics(const Skeleton& skeleton,
                                                 const Eigen::Ref<const Eigen::VectorXd>& frame) {
  if (frame.size() != skeleton.ChannelCount()) {
    throw std::logic_error("a frame has " + std::to_string(frame.size()) +
                           " values, its skeleton " + std::to_string(skeleton.ChannelCount()) +
                           " channels");
  }
  std::vector<Eigen::Isometry3d> world_from_joint;
  world_from_joint.reserve(skeleton.joints.size());
  const double* values = frame.data();
  for (const Joint& joint : skeleton.joints) {
    if (joint.parent < -1 || joint.parent >= static_cast<int>(world_from_joint.size())) {
      throw std::logic_error(joint.name + " does not stand after its parent");
    }
    const Eigen::Isometry3d parent_from_joint = ParentFromJoint(joint, values);
    world_from_joint.push_back(joint.parent < 0
                                   ? parent_from_joint
                                   : world_from_joint[static_cast<std::size_t>(joint.parent)] *
                                         parent_from_joint);
    values += joint.channels.size();
  }
  return world_from_joint;
}

}  // namespace deixis::motion
