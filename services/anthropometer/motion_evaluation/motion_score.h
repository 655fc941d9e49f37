#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/range_of_motion/range_of_motion.h"
#include "common/retargeting/retarget.h"

namespace deixis::anthropometer {

/// A joint of either side, and a motion that ends at a limit: "wrist", "dorsal_extension".
using Cause = std::pair<std::string, std::string>;

/// What limits say of one joint. A joint-frame is one joint in one frame, rejected when any of its
/// angles is beyond its limit.
struct JointScore {
  long joint_frames = 0;
  long rejected = 0;
};

/// Joint-frames beyond one limit.
struct CauseScore {
  long rejected = 0;       ///< Of which this was exceeded most.
  double worst_deg = 0.0;  ///< Largest excess.
};

/// One recording.
struct ClipScore {
  std::string name;
  long frames = 0;
  long joint_frames = 0, rejected = 0;  ///< Of sound joints.
  std::vector<std::string> faulty;      ///< Joints that the recording has wrong, with their sides.
  double mean_error_m = 0.0, largest_error_m = 0.0;  ///< Of joints, model against file.
};

/// A joint that is anywhere more than `kFault_deg` beyond the source's limits is nobody's: the
/// recording is wrong there, as where its solver swapped markers. That joint and those beyond it
/// are counted apart in that recording.
struct MotionScore {
  static constexpr double kFault_deg = 45.0;

  std::map<std::string, JointScore> joints;
  std::map<Cause, CauseScore> causes;
  JointScore faulty;
  std::vector<ClipScore> clips;

  double RejectedShare() const;
};

struct Judges {
  const range_of_motion::RangePlan& plan;
  const anatomy::JointLimits& rows;
  range_of_motion::Limits limits = range_of_motion::Limits::kDefault;
};

/// By joint of RangeOfMotion: whether the recording has it wrong.
std::vector<bool> FindFaults(const retargeting::BodyMotion& motion, const Judges& judges);

/// Adds a recording.
void AddClip(const std::string& name, const retargeting::Retargeted& recording,
             const Judges& judges, MotionScore& score);

/// The plan with what these recordings, judged by the source, need: each excess rounded up to five
/// degrees.
range_of_motion::RangePlan WithAllowancesFor(const MotionScore& by_source,
                                             range_of_motion::RangePlan plan);

}  // namespace deixis::anthropometer
