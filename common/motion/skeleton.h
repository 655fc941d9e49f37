#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace deixis::motion {

/// What one number of a frame does to its joint; translations in metres, rotations in radians.
enum class ChannelKind {
  kXTranslation,
  kYTranslation,
  kZTranslation,
  kXRotation,
  kYRotation,
  kZRotation
};

struct Joint {
  std::string name;
  int parent = -1;  ///< Index of the parent, less than the joint's own; -1: a root.
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();  ///< From the parent's joint, in its frame.
  /// How the joint stands in its parent's frame when its channels are zero (the `orientation` of an
  /// ASF file's root).
  Eigen::Quaterniond rest_rotation = Eigen::Quaterniond::Identity();
  /// The frame C that the rotations turn about (ASF's `axis`): R = rest C M C^-1.
  Eigen::Quaterniond pre_rotation = Eigen::Quaterniond::Identity();
  std::vector<ChannelKind> channels;  ///< Rotations multiply from left to right in this order.
  std::vector<Eigen::Vector3d> end_sites_m;  ///< Ends without a joint, in this joint's frame.
};

/// Joints, parents before their children; a frame holds their channels one joint after the other.
struct Skeleton {
  std::vector<Joint> joints;
  Eigen::Index ChannelCount() const;
};

/// A recorded motion: a row per frame, a column per channel of the skeleton.
struct Clip {
  Skeleton skeleton;
  double frame_rate_hz = 0.0;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> frames;
};

/// Pose of a joint in its parent's frame; `values` holds its channels. Translations add to the
/// offset.
Eigen::Isometry3d ParentFromJoint(const Joint& joint, const double* values);

bool IsTranslation(ChannelKind kind);

/// World pose of each joint, in the order of the skeleton. Throws std::logic_error when
/// `frame` has another length than the skeleton has channels, or when a parent does not stand
/// before its child.
std::vector<Eigen::Isometry3d> ForwardKinematics(const Skeleton& skeleton,
                                                 const Eigen::Ref<const Eigen::VectorXd>& frame);

}  // namespace deixis::motion
