#include "common/range_of_motion/range_of_motion.h"

#include <optional>

#include "common/config/config.h"

namespace deixis::range_of_motion {
namespace {

using body_model::BodyModel;

std::string Prefix(BodySide side) {
  if (side == BodySide::kMiddle) return "";
  return side == BodySide::kRight ? "right_" : "left_";
}

/// The plan's limbs that the model has, in their order; none = the joint is not in it.
std::vector<int> LimbsOf(const BodyModel& model, const JointPlan& plan, BodySide side) {
  std::vector<int> limbs;
  for (const LimbShare& share : plan.limbs) {
    const auto found = model.Find(Prefix(side) + share.limb);
    if (found && model.limbs()[static_cast<std::size_t>(*found)].parent >= 0) {
      limbs.push_back(*found);
    }
  }
  return limbs;
}

void RequireChain(const BodyModel& model, const JointPlan& plan, const std::vector<int>& limbs) {
  for (std::size_t i = 1; i < limbs.size(); ++i) {
    const body_model::Limb& limb = model.limbs()[static_cast<std::size_t>(limbs[i])];
    if (limb.parent != limbs[i - 1]) {
      throw config::ConfigError("joint '" + plan.joint + "': limb '" + limb.name +
                                "' does not hang on the one before it");
    }
  }
}

}  // namespace

std::string ModelJoint::Name() const { return Prefix(joint.side()) + joint.joint(); }

RangeOfMotion::RangeOfMotion(const BodyModel& model, const RangePlan& plan,
                             const anatomy::JointLimits& rows, Limits limits) {
  for (const JointPlan& joint : plan.joints) {
    for (const BodySide side : {BodySide::kMiddle, BodySide::kRight, BodySide::kLeft}) {
      const std::vector<int> limbs = LimbsOf(model, joint, side);
      if (limbs.empty()) continue;
      RequireChain(model, joint, limbs);
      const int parent = model.limbs()[static_cast<std::size_t>(limbs.front())].parent;
      joints_.push_back({AnatomicalJoint(joint, side, rows, limits), parent, limbs.back()});
    }
  }
}

AnatomicalAngles RangeOfMotion::Measure(const body_model::Kinematics& kinematics,
                                        const ModelJoint& joint) const {
  return joint.joint.Measure(kinematics.limb(joint.parent).linear().transpose() *
                             kinematics.limb(joint.limb).linear());
}

}  // namespace deixis::range_of_motion
