#include "common/range_of_motion/range_of_motion.h"

#include <algorithm>
#include <cmath>
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

RangePlan LoadRangePlan(const std::filesystem::path& path, const anatomy::JointLimits& rows) {
  RangePlan plan = LoadRangePlan(path);
  for (std::size_t i = 0; i < plan.joints.size(); ++i) {
    try {
      const AnatomicalJoint tried(plan.joints[i], BodySide::kRight, rows, Limits::kDefault);
    } catch (const config::ConfigError& error) {
      throw config::ConfigError(config::PlaceOf(path, "joints[" + std::to_string(i) + "]") + ": " +
                                error.what());
    }
  }
  return plan;
}

std::string ModelJoint::Name() const { return Prefix(joint.side()) + joint.joint(); }

RangeOfMotion::RangeOfMotion(const BodyModel& model, const RangePlan& plan,
                             const anatomy::JointLimits& rows, Limits limits) {
  for (const JointPlan& joint : plan.joints) {
    for (const BodySide side : {BodySide::kMiddle, BodySide::kRight, BodySide::kLeft}) {
      const std::vector<int> limbs = LimbsOf(model, joint, side);
      if (limbs.empty()) continue;
      RequireChain(model, joint, limbs);
      const int parent = model.limbs()[static_cast<std::size_t>(limbs.front())].parent;
      joints_.push_back({AnatomicalJoint(joint, side, rows, limits), parent, limbs.back(), -1,
                         joint.shares_rotation_below_deg * M_PI / 180.0});
    }
  }
  for (ModelJoint& joint : joints_) {
    if (joint.shares_below_rad == 0.0) continue;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      if (joints_[i].limb == joint.parent && joints_[i].joint.HasRotation())
        joint.shares_with = static_cast<int>(i);
    }
  }
}

void RangeOfMotion::Check(const body_model::Kinematics& kinematics, std::vector<JointState>& states,
                          Load load) const {
  states.resize(joints_.size());
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    states[i].angles = Measure(kinematics, joints_[i]);
    states[i].margins = joints_[i].joint.Check(states[i].angles, load);
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (joints_[i].shares_with >= 0) ShareRotation(i, states, load);
  }
}

void RangeOfMotion::ShareRotation(std::size_t joint, std::vector<JointState>& states,
                                  Load load) const {
  const auto other = static_cast<std::size_t>(joints_[joint].shares_with);
  if (states[joint].angles[0] >= joints_[joint].shares_below_rad) return;
  const auto own = joints_[joint].joint.RotationOf(states[joint].angles, load);
  const auto above = joints_[other].joint.RotationOf(states[other].angles, load);
  const double sum_rad = own.angle_rad + above.angle_rad;
  const double margin_rad =
      std::min(own.most_rad + above.most_rad - sum_rad, sum_rad - own.least_rad - above.least_rad);
  for (const std::size_t i : {joint, other}) {
    Margins& margins = states[i].margins;
    Margin& rotation = margins.each[static_cast<std::size_t>(margins.count - 1)];
    rotation.margin_rad = std::max(rotation.margin_rad, margin_rad);
  }
}

AnatomicalAngles RangeOfMotion::Measure(const body_model::Kinematics& kinematics,
                                        const ModelJoint& joint) const {
  return joint.joint.Measure(kinematics.limb(joint.parent).linear().transpose() *
                             kinematics.limb(joint.limb).linear());
}

}  // namespace deixis::range_of_motion
