#include "services/pose_fitter/trainer/clothed_plan.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "common/config/config.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyPlan;
using body_model::LengthPlan;
using body_model::LimbPlan;
using Eigen::Vector3d;

// Shares of the stature: where surfaces end that no joint ends.
constexpr double kHipHeight = 0.045;  // Of the hips above the base limb's begin.
constexpr double kChestAboveShoulder = 0.015;
constexpr double kClavicleBeside = 0.015;  // Its joint from the middle.
constexpr double kDeltoidLength = 0.018;
// The chest bends on the abdomen at this share of the way from the hips to the neck: rigs put that
// joint elsewhere in women and in men, which no body shows.
constexpr double kChestJoint = 0.68;

LimbPlan& Find(BodyPlan& plan, const std::string& name) {
  const auto found = std::find_if(plan.limbs.begin(), plan.limbs.end(),
                                  [&name](const LimbPlan& limb) { return limb.name == name; });
  if (found == plan.limbs.end()) throw config::ConfigError(plan.name + " has no limb " + name);
  return *found;
}

LengthPlan Stature(double share) { return {{"kph", share, 0.0, 0.0}}; }

body_model::EllipsePlan Ellipse(double a, double b) { return {Stature(a), Stature(b), {}, {}}; }

LimbPlan Fixed(const std::string& name, const LimbPlan& parent, const Vector3d& rest_z,
               const Vector3d& rest_x) {
  LimbPlan limb;
  limb.name = name;
  limb.parent = parent.name;
  limb.side = parent.side;
  limb.rest_z.assign(rest_z.data(), rest_z.data() + 3);
  limb.rest_x.assign(rest_x.data(), rest_x.data() + 3);
  limb.length = Stature(0.03);
  return limb;
}

void AddFixedLimbs(BodyPlan& plan) {
  const Vector3d x = Vector3d::UnitX(), z = Vector3d::UnitZ();
  LimbPlan neck_base = Fixed("neck_base", Find(plan, "chest"), z, x);
  neck_base.proximal = Ellipse(0.05, 0.07);
  neck_base.distal = Ellipse(0.038, 0.038);
  LimbPlan deltoid = Fixed("deltoid", Find(plan, "clavicle"), z, x);
  deltoid.proximal = Ellipse(0.032, 0.035);
  deltoid.distal = Ellipse(0.02, 0.025);
  LimbPlan jaw = Fixed("jaw", Find(plan, "head"), -z, x);
  jaw.proximal = Ellipse(0.045, 0.04);
  jaw.distal = Ellipse(0.035, 0.03);
  LimbPlan skull_cap = Fixed("skull_cap", Find(plan, "head"), z, x);
  skull_cap.proximal = Ellipse(0.055, 0.045);
  skull_cap.distal = Ellipse(0.03, 0.025);
  for (const LimbPlan& limb : {neck_base, deltoid, jaw, skull_cap}) plan.limbs.push_back(limb);
}

/// Upright axes of a standing person in the camera frame: x forward, y left, z up.
Eigen::Matrix3d UprightAxes(const Markers& markers, const Vector3d& up) {
  const Vector3d left = markers.at("l_hip") - markers.at("r_hip");
  Eigen::Matrix3d axes;
  axes.col(2) = up;
  axes.col(1) = (left - left.dot(up) * up).normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return axes;
}

/// Differences of markers in a person's upright axes, sides averaged.
class Upright {
 public:
  Upright(const RenderedPerson& person, int frame)
      : markers_(person.frames.at(static_cast<std::size_t>(frame))),
        axes_(UprightAxes(markers_, person.up)) {}

  Vector3d Middle(const std::string& from, const std::string& to) const {
    Vector3d offset_m = Between(from, to);
    offset_m.y() = 0.0;
    return offset_m;
  }
  /// To a marker on both sides, of the right one.
  Vector3d Right(const std::string& from, const std::string& to) const {
    const Vector3d right_m = Between(from, "r_" + to), left_m = Between(from, "l_" + to);
    return 0.5 * (right_m + Vector3d(left_m.x(), -left_m.y(), left_m.z()));
  }
  /// The chest's joint, from the middle between the hips.
  Vector3d Chest() const { return kChestJoint * Middle("pelvis", "neck"); }
  /// The right shoulder, from the chest's joint.
  Vector3d Shoulder() const { return Right("pelvis", "shoulder") - Chest(); }

 private:
  Vector3d Between(const std::string& from, const std::string& to) const {
    return axes_.transpose() * (markers_.at(to) - markers_.at(from));
  }

  const Markers& markers_;
  Eigen::Matrix3d axes_;
};

void SetPoint(Lengths& lengths, const std::string& limb, const Vector3d& place_m) {
  lengths[limb + ".origin.x"] = place_m.x();
  lengths[limb + ".origin.y"] = place_m.y();
  lengths[limb + ".origin.z"] = place_m.z();
}

void AddTrunk(const Upright& upright, double stature_m, Lengths& lengths) {
  const Vector3d hips(0.0, 0.0, kHipHeight * stature_m);
  const Vector3d spine = hips + upright.Middle("pelvis", "spine");
  const Vector3d chest = upright.Chest() - upright.Middle("pelvis", "spine");
  const Vector3d neck = upright.Middle("pelvis", "neck") - upright.Chest();
  lengths["pelvis.length"] = spine.z();
  SetPoint(lengths, "abdomen", spine);
  lengths["abdomen.length"] = chest.z();
  SetPoint(lengths, "chest", chest);
  const double top_m = upright.Shoulder().z() + kChestAboveShoulder * stature_m;
  lengths["chest.length"] = top_m;
  SetPoint(lengths, "neck_base", {neck.x(), 0.0, top_m});
  lengths["neck_base.length"] = neck.z() - top_m;
  SetPoint(lengths, "neck", neck);
}

void AddHead(const Upright& upright, Lengths& lengths) {
  const Vector3d head = upright.Middle("neck", "head");
  const Vector3d along = Vector3d(kNeckLean, 0.0, 1.0).normalized();
  const Vector3d across = Vector3d(1.0, 0.0, -kNeckLean).normalized();
  lengths["neck.length"] = head.dot(along);
  SetPoint(lengths, "head", {head.dot(across), 0.0, head.dot(along)});
  const double top_m = upright.Middle("head", "head_top").z();
  lengths["head.length"] = 0.5 * top_m;
  SetPoint(lengths, "skull_cap", {0.0, 0.0, 0.5 * top_m});
  lengths["skull_cap.length"] = 0.5 * top_m;
  SetPoint(lengths, "jaw", Vector3d::Zero());
  lengths["jaw.length"] = -upright.Middle("head", "chin").z();
}

void AddArm(const Upright& upright, const RenderedPerson& person, Lengths& lengths) {
  const Vector3d shoulder = upright.Shoulder();
  const double beside_m = kClavicleBeside * person.stature_m;
  SetPoint(lengths, "clavicle", {shoulder.x(), -beside_m, shoulder.z()});
  const double clavicle_m = -shoulder.y() - beside_m;
  lengths["clavicle.length"] = clavicle_m;
  SetPoint(lengths, "deltoid", {0.0, 0.0, clavicle_m});
  lengths["deltoid.length"] = kDeltoidLength * person.stature_m;
  SetPoint(lengths, "upper_arm", {0.0, 0.0, clavicle_m});
  lengths["upper_arm.length"] = person.lengths_m.at("r_upper_arm");
  SetPoint(lengths, "lower_arm", {0.0, 0.0, lengths["upper_arm.length"]});
  lengths["lower_arm.length"] = person.lengths_m.at("r_forearm");
  SetPoint(lengths, "hand", {0.0, 0.0, lengths["lower_arm.length"]});
  lengths["hand.length"] = person.lengths_m.at("r_hand");
}

void AddLeg(const Upright& upright, const RenderedPerson& person, Lengths& lengths) {
  Vector3d hip = upright.Right("pelvis", "hip");
  hip.z() += kHipHeight * person.stature_m;
  SetPoint(lengths, "thigh", hip);
  lengths["thigh.length"] = person.lengths_m.at("r_thigh");
  SetPoint(lengths, "shank", {0.0, 0.0, lengths["thigh.length"]});
  lengths["shank.length"] = person.lengths_m.at("r_lower_leg");
  SetPoint(lengths, "foot", {0.0, 0.0, lengths["shank.length"]});
  lengths["foot.length"] = person.lengths_m.at("r_foot");
}

}  // namespace

BodyPlan ClothedPlan(const BodyPlan& detailed) {
  BodyPlan plan = detailed;
  plan.name = "clothed_body";
  Find(plan, "neck").rest_z = {kNeckLean, 0.0, 1.0};
  Find(plan, "neck").rest_x = {1.0, 0.0, -kNeckLean};
  Find(plan, "head").rest_z = {-kNeckLean, 0.0, 1.0};
  Find(plan, "head").rest_x = {1.0, 0.0, kNeckLean};
  AddFixedLimbs(plan);
  return plan;
}

BodyPlan WithLengths(const BodyPlan& plan, const Lengths& lengths) {
  BodyPlan changed = plan;
  for (LimbPlan& limb : changed.limbs) {
    body_model::ForEachLength(limb, [&](const char* key, LengthPlan& length) {
      const auto found = lengths.find(limb.name + "." + key);
      if (found != lengths.end()) length = {{"", 1.0, found->second, 0.0}};
    });
  }
  return changed;
}

Lengths JointTree(const RenderedPerson& person, int frame) {
  const Upright upright(person, frame);
  Lengths lengths;
  AddTrunk(upright, person.stature_m, lengths);
  AddHead(upright, lengths);
  AddArm(upright, person, lengths);
  AddLeg(upright, person, lengths);
  return lengths;
}

}  // namespace deixis::pose_fitter
