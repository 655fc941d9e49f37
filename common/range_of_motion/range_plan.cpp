#include "common/range_of_motion/range_plan.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "common/config/config.h"

namespace deixis::range_of_motion {
namespace {

bool IsDirection(const std::vector<double>& values) {
  return values.size() == 3 && std::hypot(values[0], values[1], values[2]) > 1e-3;
}

/// 0, 1 or 2 for x, y or z; -1 when it is none of them.
int CoordinateOf(const std::vector<double>& axis) {
  if (axis.size() != 3) return -1;
  for (int i = 0; i < 3; ++i) {
    const auto at = [&axis, i](int k) { return axis[static_cast<std::size_t>((i + k) % 3)]; };
    if (std::abs(at(0)) == 1.0 && at(1) == 0.0 && at(2) == 0.0) return i;
  }
  return -1;
}

/// Each coordinate at most once, z last; with a reach cone only z.
bool IsOrderOfAngles(const std::vector<AnglePlan>& angles, bool has_reach) {
  std::vector<int> seen;
  for (const AnglePlan& angle : angles) {
    const int coordinate = CoordinateOf(angle.axis);
    const bool is_new = std::find(seen.begin(), seen.end(), coordinate) == seen.end();
    const bool is_after_z = !seen.empty() && seen.back() == 2;
    if (!is_new || is_after_z || (has_reach && coordinate != 2)) return false;
    seen.push_back(coordinate);
  }
  return true;
}

bool Moves(const JointPlan& plan, const std::string& motion) {
  const auto by_angle = [&motion](const AnglePlan& angle) {
    return angle.positive == motion || angle.negative == motion;
  };
  const auto by_knot = [&motion](const KnotPlan& knot) { return knot.motion == motion; };
  return std::any_of(plan.angles.begin(), plan.angles.end(), by_angle) ||
         std::any_of(plan.reach.knots.begin(), plan.reach.knots.end(), by_knot);
}

bool HasRotation(const JointPlan& plan) {
  return !plan.angles.empty() && CoordinateOf(plan.angles.back().axis) == 2;
}

}  // namespace

void LimbShare::Validate() const {
  config::Faults faults;
  faults.Require(!limb.empty(), "limb", "must not be empty");
  faults.Require(share >= 0.0 && share <= 1.0, "share", "must lie in 0..1");
  faults.ThrowIfAny();
}

void AnglePlan::Validate() const {
  config::Faults faults;
  faults.Require(!name.empty(), "name", "must not be empty");
  faults.Require(CoordinateOf(axis) >= 0, "axis",
                 "must be x, y or z or its opposite, as [0, -1, 0]");
  faults.Require(!positive.empty(), "positive", "must name a motion");
  faults.Require(!negative.empty(), "negative", "must name a motion");
  faults.ThrowIfAny();
}

void KnotPlan::Validate() const {
  config::Faults faults;
  faults.Require(IsDirection(towards), "towards", "must be three numbers, not all zero");
  faults.Require(motion.empty() != (degrees == 0.0), "degrees",
                 "must stand where no motion is named, and only there");
  faults.Require(degrees >= 0.0 && degrees <= 360.0, "degrees", "must lie in 0..360");
  faults.Require(degrees == 0.0 || !why.empty(), "why", "must say where the degrees come from");
  faults.ThrowIfAny();
}

void AllowancePlan::Validate() const {
  config::Faults faults;
  faults.Require(!motion.empty(), "motion", "must not be empty");
  faults.Require(degrees > 0.0 && degrees <= 90.0, "degrees", "must lie in 0..90");
  faults.Require(!why.empty(), "why", "must say who does more than the row");
  faults.ThrowIfAny();
}

void JointPlan::Validate() const {
  config::Faults faults;
  faults.Require(!joint.empty(), "joint", "must not be empty");
  faults.Require(!limbs.empty(), "limbs", "must name a limb");
  faults.Require(IsDirection(neutral_z), "neutral_z", "must be three numbers, not all zero");
  faults.Require(IsDirection(neutral_x), "neutral_x", "must be three numbers, not all zero");
  const bool has_reach = !reach.knots.empty();
  faults.Require(!has_reach || IsDirection(reach.rest_z), "reach.rest_z",
                 "must be three numbers, not all zero");
  faults.Require(!has_reach || reach.knots.size() >= 3, "reach.knots", "must be three or more");
  faults.Require(IsOrderOfAngles(angles, has_reach), "angles",
                 has_reach ? "must turn about z only beside a reach"
                           : "must turn about x, y, z once at most, about z last");
  faults.Require(has_reach || !angles.empty(), "angles", "must not be empty without a reach");
  faults.Require(shares_rotation_below_deg >= 0.0 && shares_rotation_below_deg <= 45.0,
                 "shares_rotation_below_deg", "must lie in 0..45");
  faults.Require(shares_rotation_below_deg == 0.0 || HasRotation(*this),
                 "shares_rotation_below_deg", "must stand only where the last angle is about z");
  for (const AllowancePlan& allowance : allowed_beyond) {
    faults.Require(Moves(*this, allowance.motion), "allowed_beyond",
                   "'" + allowance.motion + "' is no motion of this joint");
  }
  faults.ThrowIfAny();
}

void RangePlan::Validate() const {
  config::Faults faults;
  faults.Require(!joints.empty(), "joints", "must name a joint");
  std::set<std::string> seen;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    faults.Require(seen.insert(joints[i].joint).second, "joints[" + std::to_string(i) + "].joint",
                   "'" + joints[i].joint + "' is there already");
  }
  faults.ThrowIfAny();
}

RangePlan LoadRangePlan(const std::filesystem::path& path) { return config::Load<RangePlan>(path); }

}  // namespace deixis::range_of_motion
