#pragma once
#include "common/motion/skeleton.h"
#include "common/retargeting/retarget.h"

namespace deixis::retargeting {

/// The motion as a clip that BVH can hold: a joint per limb, y up and z forward; zero pose: the
/// model as it stands, arms hanging. The base has position and rotation, the others ZXY rotations;
/// limbs without children have an end site.
motion::Clip ToClip(const BodyMotion& motion);

}  // namespace deixis::retargeting
