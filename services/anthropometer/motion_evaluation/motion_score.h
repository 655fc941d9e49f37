#pragma once
#include <map>
#include <string>
#include <vector>

#include "common/range_of_motion/range_of_motion.h"
#include "common/retargeting/retarget.h"

namespace deixis::anthropometer {

/// What limits say of recorded motion, by joint of either side; a joint-frame is one joint in one
/// frame, rejected when any of its angles is beyond its limit.
struct JointScore {
  long joint_frames = 0;
  long rejected = 0;
  std::map<std::string, long> by_motion;  ///< Of the limit that was exceeded most.
  double worst_deg = 0.0;                 ///< Largest excess.
};

/// One recording.
struct ClipScore {
  std::string name;
  long frames = 0;
  long joint_frames = 0;
  long rejected = 0;
  double mean_error_m = 0.0, largest_error_m = 0.0;  ///< Of joints, model against file.
};

struct MotionScore {
  std::map<std::string, JointScore> joints;
  std::vector<ClipScore> clips;

  double RejectedShare() const;
};

/// Adds a recording, judged by `limits`.
void AddClip(const std::string& name, const retargeting::Retargeted& recording,
             const range_of_motion::RangePlan& plan, const anatomy::JointLimits& rows,
             range_of_motion::Limits limits, MotionScore& score);

}  // namespace deixis::anthropometer
