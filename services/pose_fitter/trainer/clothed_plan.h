#pragma once
#include <map>
#include <string>

#include "common/body_model/body_plan.h"
#include "services/pose_fitter/trainer/rendered_person.h"

namespace deixis::pose_fitter {

/// Lengths of one person by "<limb of the plan>.<key of its length>": "thigh.origin.y". Metres, of
/// right limbs; left ones are their mirror images.
using Lengths = std::map<std::string, double>;

/// The limbs of the clothed body: those of whole_body_detailed, joints as they are there, and
/// `neck_base`, `deltoid`, `jaw` and `skull_cap`, which are fixed and carry the surface beyond the
/// joints. Semi-axes are rough: what learning starts from. Throws ConfigError when `detailed` lacks
/// a limb.
body_model::BodyPlan ClothedPlan(const body_model::BodyPlan& detailed);

/// `plan` with these lengths in place of its own, as metres.
body_model::BodyPlan WithLengths(const body_model::BodyPlan& plan, const Lengths& lengths);

/// Joint places and limb lengths of the plan from one frame in which the person stands upright,
/// arms hanging, and what person.csv says of the limbs.
Lengths JointTree(const RenderedPerson& person, int frame);

/// Leaning of the neck, x per z of its rest direction: one for all people.
inline constexpr double kNeckLean = 0.375;

}  // namespace deixis::pose_fitter
