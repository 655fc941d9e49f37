#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "common/motion/skeleton.h"
#include "common/retargeting/skeleton_map.h"

namespace deixis::retargeting {

/// Joints of a motion's frames in the axes of the human model, metres.
class JointPaths {
 public:
  /// `clip` must outlive it.
  JointPaths(const motion::Clip& clip, const Eigen::Matrix3d& body_from_file);

  void Seek(Eigen::Index frame);
  /// The pose with all channels 0.
  void SeekZero();

  Eigen::Vector3d Start_m(const DrivenLimb& limb) const { return Position_m(limb.starts_at); }
  /// Throws std::logic_error when HasEnd does not hold.
  Eigen::Vector3d End_m(const DrivenLimb& limb) const;
  bool HasEnd(const DrivenLimb& limb) const;
  /// By how much the limb's joint is turned from the zero pose.
  Eigen::Matrix3d Turn(const DrivenLimb& limb) const;

 private:
  Eigen::Vector3d Position_m(int joint) const;

  const motion::Clip* clip_;
  Eigen::Matrix3d body_from_file_;
  std::vector<Eigen::Isometry3d> zero_;
  std::vector<Eigen::Isometry3d> now_;
};

}  // namespace deixis::retargeting
