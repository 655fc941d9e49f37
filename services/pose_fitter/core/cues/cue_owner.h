#pragma once
#include <vector>

#include "common/body_model/kinematics.h"
#include "services/pose_fitter/core/cues/part_cue.h"

namespace deixis::pose_fitter {

/// How far a cue is from where a body could show it, in reaches of that body: a hand from the
/// nearer shoulder, a face from the head. Up to 1 it may be the body's. Where the cue's distance is
/// known its place counts, else the ray alone.
double Reaches(const PartCue& cue, const body_model::Kinematics& kinematics);

}  // namespace deixis::pose_fitter
