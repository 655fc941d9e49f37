#include "services/anthropometer/motion_evaluation/motion_score.h"

#include <algorithm>
#include <cmath>

#include "common/body_model/kinematics.h"

namespace deixis::anthropometer {
namespace {

using range_of_motion::Margin;
using range_of_motion::Margins;

/// Rounding of files that write four digits.
constexpr double kTolerance_rad = 1e-6;

const Margin& Worst(const Margins& margins) {
  return *std::min_element(
      margins.each.begin(), margins.each.begin() + margins.count,
      [](const Margin& a, const Margin& b) { return a.margin_rad < b.margin_rad; });
}

/// Whether it is rejected.
bool Count(const Margin& worst, JointScore& score) {
  ++score.joint_frames;
  if (worst.margin_rad >= -kTolerance_rad) return false;
  ++score.rejected;
  ++score.by_motion[worst.motion->empty() ? "reach" : *worst.motion];
  score.worst_deg = std::max(score.worst_deg, -worst.margin_rad * 180.0 / M_PI);
  return true;
}

}  // namespace

double MotionScore::RejectedShare() const {
  long all = 0, rejected = 0;
  for (const auto& [name, joint] : joints) {
    all += joint.joint_frames;
    rejected += joint.rejected;
  }
  return all == 0 ? 0.0 : static_cast<double>(rejected) / static_cast<double>(all);
}

void AddClip(const std::string& name, const retargeting::Retargeted& recording,
             const range_of_motion::RangePlan& plan, const anatomy::JointLimits& rows,
             range_of_motion::Limits limits, MotionScore& score) {
  const body_model::BodyModel& model = recording.motion.model;
  const range_of_motion::RangeOfMotion ranges(model, plan, rows, limits);
  body_model::Kinematics kinematics(model);
  ClipScore clip{name, static_cast<long>(recording.motion.poses.size())};
  for (const body_model::BodyPose& pose : recording.motion.poses) {
    kinematics.Update(pose);
    for (const range_of_motion::ModelJoint& joint : ranges.joints()) {
      const Margins margins = joint.joint.Check(ranges.Measure(kinematics, joint));
      ++clip.joint_frames;
      clip.rejected += Count(Worst(margins), score.joints[joint.joint.joint()]) ? 1 : 0;
    }
  }
  for (const retargeting::JointError& error : recording.errors) {
    clip.mean_error_m += error.mean_m / static_cast<double>(recording.errors.size());
    clip.largest_error_m = std::max(clip.largest_error_m, error.largest_m);
  }
  score.clips.push_back(std::move(clip));
}

}  // namespace deixis::anthropometer
