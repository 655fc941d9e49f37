#include "common/range_of_motion/speed_limits.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "common/config/config.h"

namespace deixis::range_of_motion {
namespace {

constexpr double kRadiansPerDegree = M_PI / 180.0;

std::string WithoutSide(const std::string& limb) {
  for (const std::string side : {"right_", "left_"}) {
    if (limb.rfind(side, 0) == 0) return limb.substr(side.size());
  }
  return limb;
}

const JointSpeed* SpeedOf(const std::string& limb, const RangePlan& plan,
                          const SpeedLimits& limits) {
  for (const JointPlan& joint : plan.joints) {
    for (const LimbShare& share : joint.limbs) {
      if (share.limb == limb) return limits.Find(joint.joint);
    }
  }
  return nullptr;
}

void RequireRanges(const RangePlan& plan, const SpeedLimits& limits) {
  for (const JointSpeed& speed : limits.joints) {
    const bool is_known =
        std::any_of(plan.joints.begin(), plan.joints.end(),
                    [&speed](const JointPlan& joint) { return joint.joint == speed.joint; });
    if (!is_known) {
      throw config::ConfigError("limits of speed: '" + speed.joint +
                                "' is no joint of the ranges of motion");
    }
  }
}

}  // namespace

void JointSpeed::Validate() const {
  config::Faults faults;
  faults.Require(!joint.empty(), "joint", "must not be empty");
  faults.Require(speed_deg_per_s > 0.0 && speed_deg_per_s <= 1e5, "speed_deg_per_s",
                 "must lie above 0, up to 100000");
  faults.Require(acceleration_deg_per_s2 > 0.0 && acceleration_deg_per_s2 <= 1e7,
                 "acceleration_deg_per_s2", "must lie above 0, up to 10000000");
  faults.ThrowIfAny();
}

void SpeedLimits::Validate() const {
  config::Faults faults;
  faults.Require(!derived_from.empty(), "derived_from", "must say what the limits rest on");
  faults.Require(!certainty.empty(), "certainty", "must say how certain the limits are");
  std::set<std::string> seen;
  for (const JointSpeed& speed : joints) {
    faults.Require(seen.insert(speed.joint).second, "joints",
                   "'" + speed.joint + "' is there already");
  }
  faults.ThrowIfAny();
}

const JointSpeed* SpeedLimits::Find(const std::string& joint) const {
  const auto found = std::find_if(joints.begin(), joints.end(), [&joint](const JointSpeed& speed) {
    return speed.joint == joint;
  });
  return found == joints.end() ? nullptr : &*found;
}

SpeedLimits LoadSpeedLimits(const std::filesystem::path& path) {
  return config::Load<SpeedLimits>(path);
}

body_model::BodyModel WithSpeedLimits(const body_model::BodyModel& model, const RangePlan& plan,
                                      const SpeedLimits& limits) {
  RequireRanges(plan, limits);
  std::vector<body_model::Limb> limbs = model.limbs();
  for (body_model::Limb& limb : limbs) {
    const JointSpeed* speed = SpeedOf(WithoutSide(limb.name), plan, limits);
    if (speed == nullptr) continue;
    for (body_model::DegreeOfFreedom& dof : limb.dofs) {
      dof.speed_max_rad_per_s = speed->speed_deg_per_s * kRadiansPerDegree;
      dof.acceleration_max_rad_per_s2 = speed->acceleration_deg_per_s2 * kRadiansPerDegree;
    }
  }
  return {model.name(), std::move(limbs)};
}

}  // namespace deixis::range_of_motion
