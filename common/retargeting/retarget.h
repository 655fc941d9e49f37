#pragma once
#include <string>
#include <vector>

#include "common/body_model/body_model.h"
#include "common/motion/skeleton.h"
#include "common/retargeting/skeleton_map.h"

namespace deixis::retargeting {

/// A recorded motion as poses of the human model. World: z up, metres; x and y are front and left
/// of the file's zero pose.
struct BodyMotion {
  body_model::BodyModel model;  ///< With the recorded person's lengths.
  double frame_rate_hz = 0.0;
  std::vector<body_model::BodyPose> poses;  ///< One per frame.
};

/// How far the model's joints lie from the file's own, metres, over all frames.
struct JointError {
  std::string limb;
  double mean_m = 0.0, largest_m = 0.0;  ///< Of its proximal joint, and of its end if it has one.
};

struct Retargeted {
  BodyMotion motion;
  std::vector<JointError> errors;    ///< Of the limbs that the file drives.
  std::vector<std::string> at_rest;  ///< Limbs of the model that it does not.
  double scale = 1.0;                ///< By which the given model was scaled.
};

/// Reads a motion into poses of `model`, scaled to the recorded person: limbs get the file's
/// lengths and joint positions, the rest grows alike. Each limb turns with its joint; how it stands
/// in the zero pose is the map's. Where a hinge hangs on a ball joint (elbow, knee), the axis about
/// which the motion turns the hinge decides the twist of the limb above. Angles are as measured:
/// no limit is applied. Throws ConfigError when the skeleton does not suit.
Retargeted Retarget(const motion::Clip& clip, const SkeletonMap& map,
                    const body_model::BodyModel& model);

}  // namespace deixis::retargeting
