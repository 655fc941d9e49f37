#include "services/anthropometer/motion_evaluation/motion_score.h"

#include <algorithm>
#include <cmath>

#include "common/body_model/kinematics.h"

namespace deixis::anthropometer {
namespace {

using range_of_motion::JointState;
using range_of_motion::Limits;
using range_of_motion::Margin;
using range_of_motion::Margins;
using range_of_motion::ModelJoint;
using range_of_motion::RangeOfMotion;

constexpr double kDegreesPerRadian = 180.0 / M_PI;
/// Rounding of files that write four digits.
constexpr double kTolerance_deg = 1e-3;
constexpr double kRounding_deg = 5.0;

const Margin& WorstOf(const Margins& margins) {
  return *std::min_element(
      margins.each.begin(), margins.each.begin() + margins.count,
      [](const Margin& a, const Margin& b) { return a.margin_rad < b.margin_rad; });
}

double ExcessOf(const Margin& margin) { return -margin.margin_rad * kDegreesPerRadian; }

/// Calls `see` with each frame's joint states.
template <typename See>
void ForEachFrame(const retargeting::BodyMotion& motion, const RangeOfMotion& ranges, See see) {
  body_model::Kinematics kinematics(motion.model);
  std::vector<JointState> states;
  for (const body_model::BodyPose& pose : motion.poses) {
    kinematics.Update(pose);
    ranges.Check(kinematics, states);
    see(states);
  }
}

bool HangsOn(const body_model::BodyModel& model, int limb, int ancestor) {
  while (limb >= 0 && limb != ancestor) limb = model.limbs()[static_cast<std::size_t>(limb)].parent;
  return limb == ancestor;
}

bool Count(const Margin& worst, JointScore& score) {
  ++score.joint_frames;
  const bool is_rejected = ExcessOf(worst) > kTolerance_deg;
  score.rejected += is_rejected ? 1 : 0;
  return is_rejected;
}

std::string NameOf(const Margin& margin) {
  return margin.motion->empty() ? "reach" : *margin.motion;
}

/// Counts one joint of a recording that is right about it.
bool CountSound(const std::string& joint, const Margins& margins, MotionScore& score) {
  for (int i = 0; i < margins.count; ++i) {
    const Margin& margin = margins.each[static_cast<std::size_t>(i)];
    if (ExcessOf(margin) <= kTolerance_deg) continue;
    CauseScore& cause = score.causes[{joint, NameOf(margin)}];
    cause.worst_deg = std::max(cause.worst_deg, ExcessOf(margin));
  }
  const Margin& worst = WorstOf(margins);
  const bool is_rejected = Count(worst, score.joints[joint]);
  if (is_rejected) ++score.causes[{joint, NameOf(worst)}].rejected;
  return is_rejected;
}

}  // namespace

std::vector<bool> FindFaults(const retargeting::BodyMotion& motion, const Judges& judges) {
  const RangeOfMotion ranges(motion.model, judges.plan, judges.rows, Limits::kSource);
  const auto& joints = ranges.joints();
  std::vector<bool> faults(joints.size(), false);
  ForEachFrame(motion, ranges, [&](const std::vector<JointState>& states) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (ExcessOf(WorstOf(states[i].margins)) > MotionScore::kFault_deg) faults[i] = true;
    }
  });
  const std::vector<bool> own = faults;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    for (std::size_t k = 0; k < joints.size(); ++k) {
      if (own[k] && HangsOn(motion.model, joints[i].limb, joints[k].limb)) faults[i] = true;
    }
  }
  return faults;
}

double MotionScore::RejectedShare() const {
  long all = 0, rejected = 0;
  for (const auto& [name, joint] : joints) {
    all += joint.joint_frames;
    rejected += joint.rejected;
  }
  return all == 0 ? 0.0 : static_cast<double>(rejected) / static_cast<double>(all);
}

void AddClip(const std::string& name, const retargeting::Retargeted& recording,
             const Judges& judges, MotionScore& score) {
  const RangeOfMotion ranges(recording.motion.model, judges.plan, judges.rows, judges.limits);
  const std::vector<bool> faults = FindFaults(recording.motion, judges);
  ClipScore clip;
  clip.name = name;
  clip.frames = static_cast<long>(recording.motion.poses.size());
  for (std::size_t i = 0; i < faults.size(); ++i) {
    if (faults[i]) clip.faulty.push_back(ranges.joints()[i].Name());
  }
  ForEachFrame(recording.motion, ranges, [&](const std::vector<JointState>& states) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (faults[i]) {
        Count(WorstOf(states[i].margins), score.faulty);
        continue;
      }
      ++clip.joint_frames;
      const std::string& joint = ranges.joints()[i].joint.joint();
      clip.rejected += CountSound(joint, states[i].margins, score) ? 1 : 0;
    }
  });
  for (const retargeting::JointError& error : recording.errors) {
    clip.mean_error_m += error.mean_m / static_cast<double>(recording.errors.size());
    clip.largest_error_m = std::max(clip.largest_error_m, error.largest_m);
  }
  score.clips.push_back(std::move(clip));
}

range_of_motion::RangePlan WithAllowancesFor(const MotionScore& by_source,
                                             range_of_motion::RangePlan plan) {
  for (range_of_motion::JointPlan& joint : plan.joints) {
    joint.allowed_beyond.clear();
    for (const auto& [cause, score] : by_source.causes) {
      if (cause.first != joint.joint) continue;
      joint.allowed_beyond.push_back(
          {cause.second, kRounding_deg * std::ceil(score.worst_deg / kRounding_deg), "measured"});
    }
  }
  return plan;
}

}  // namespace deixis::anthropometer
