#include "common/retargeting/joint_paths.h"

#include <stdexcept>

namespace deixis::retargeting {

JointPaths::JointPaths(const motion::Clip& clip, const Eigen::Matrix3d& body_from_file)
    : clip_(&clip), body_from_file_(body_from_file) {
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(clip.skeleton.ChannelCount());
  zero_ = ForwardKinematics(clip.skeleton, still);
  now_ = zero_;
}

void JointPaths::Seek(Eigen::Index frame) {
  now_ = ForwardKinematics(clip_->skeleton, clip_->frames.row(frame).transpose());
}

void JointPaths::SeekZero() { now_ = zero_; }

Eigen::Vector3d JointPaths::Position_m(int joint) const {
  return body_from_file_ * now_[static_cast<std::size_t>(joint)].translation();
}

bool JointPaths::HasEnd(const DrivenLimb& limb) const {
  return limb.ends_at >= 0 ||
         !clip_->skeleton.joints[static_cast<std::size_t>(limb.joint)].end_sites_m.empty();
}

Eigen::Vector3d JointPaths::End_m(const DrivenLimb& limb) const {
  if (limb.ends_at >= 0) return Position_m(limb.ends_at);
  const auto joint = static_cast<std::size_t>(limb.joint);
  const auto& sites_m = clip_->skeleton.joints[joint].end_sites_m;
  if (sites_m.empty()) throw std::logic_error("a limb without an end");
  return body_from_file_ * (now_[joint] * sites_m.front());
}

Eigen::Matrix3d JointPaths::Turn(const DrivenLimb& limb) const {
  const auto joint = static_cast<std::size_t>(limb.joint);
  return body_from_file_ * now_[joint].linear() * zero_[joint].linear().transpose() *
         body_from_file_.transpose();
}

}  // namespace deixis::retargeting
