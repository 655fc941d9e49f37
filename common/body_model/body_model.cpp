#include "common/body_model/body_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "common/body_model/content_hash.h"
#include "common/config/config.h"

namespace deixis::body_model {
namespace {

constexpr double kUnitTolerance = 1e-6;
constexpr double kLeastSine = 1e-3;  // Between the axes of two swings.
constexpr double kWidestAngle_rad = 2.0 * M_PI;

[[noreturn]] void Fail(const std::string& limb, const std::string& key, const std::string& fault) {
  throw LimbFault(limb, key, fault);
}

void RequireTree(const std::vector<Limb>& limbs) {
  if (limbs.empty()) throw config::ConfigError("a body has at least one limb");
  if (limbs.size() > BodyModel::kMostLimbs) {
    throw config::ConfigError("more limbs than " + std::to_string(BodyModel::kMostLimbs));
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    const Limb& limb = limbs[i];
    if (limb.name.empty()) throw config::ConfigError("limb " + std::to_string(i) + " has no name");
    if (!names.insert(limb.name).second) Fail(limb.name, "name", "occurs twice");
    if (i == 0 && limb.parent != -1)
      Fail(limb.name, "parent", "is the first one, so it must have no parent");
    if (i > 0 && (limb.parent < 0 || limb.parent >= static_cast<int>(i))) {
      Fail(limb.name, "parent", "parent must be one of the limbs before it");
    }
  }
}

void RequireSize(const Limb& limb, const char* key, double size_m) {
  if (size_m > 0.0 && size_m <= BodyModel::kLargest_m) return;
  Fail(limb.name, key,
       std::string(key) + " is " + std::to_string(size_m) + " m; must be positive and at most " +
           std::to_string(static_cast<int>(BodyModel::kLargest_m)));
}

void RequireNear(const Limb& limb, const char* key, double largest_m) {
  if (largest_m <= BodyModel::kLargest_m) return;  // NaN is not.
  Fail(limb.name, key,
       std::string(key) + " must lie within " +
           std::to_string(static_cast<int>(BodyModel::kLargest_m)) + " m");
}

void RequireShape(const Limb& limb) {
  const geometry::DegenerateCylinder& shape = limb.shape;
  RequireSize(limb, "proximal.a", shape.a0_m);
  RequireSize(limb, "proximal.b", shape.b0_m);
  RequireSize(limb, "distal.a", shape.a1_m);
  RequireSize(limb, "distal.b", shape.b1_m);
  RequireSize(limb, "length", shape.length_m);
  RequireNear(limb, "proximal", shape.centre0_m.norm());
  RequireNear(limb, "distal", shape.centre1_m.norm());
  RequireNear(limb, "origin", limb.rest_in_parent.translation_m.norm());
  if (!(std::abs(limb.rest_in_parent.rotation.norm() - 1.0) < kUnitTolerance)) {
    Fail(limb.name, "rest_z", "rest must be a rotation");
  }
}

void RequireDof(const Limb& limb, const DegreeOfFreedom& dof) {
  const auto fail = [&](const std::string& fault) {
    Fail(limb.name, "angles", dof.name + " " + fault);
  };
  if (dof.name.empty()) Fail(limb.name, "angles", "has an angle without a name");
  if (!(std::abs(dof.axis.norm() - 1.0) < kUnitTolerance)) fail("axis must be a unit vector");
  const double along = std::abs(dof.axis.z());
  if (dof.kind == DofKind::kSwing && along > kUnitTolerance)
    fail("axis must be perpendicular to z");
  if (dof.kind == DofKind::kTwist && along < 1.0 - kUnitTolerance) fail("axis must be z or -z");
  if (!(dof.angle_min_rad >= -kWidestAngle_rad && dof.angle_max_rad <= kWidestAngle_rad)) {
    fail("must lie between -360 and 360 degrees");
  }
  if (!(dof.angle_min_rad <= dof.angle_max_rad)) fail("has a minimum above its maximum");
  if (!(dof.speed_max_rad_per_s >= 0.0) || !std::isfinite(dof.speed_max_rad_per_s)) {
    fail("speed must be 0 (no limit) or more");
  }
  if (!(dof.acceleration_max_rad_per_s2 >= 0.0) ||
      !std::isfinite(dof.acceleration_max_rad_per_s2)) {
    fail("acceleration must be 0 (no limit) or more");
  }
}

/// Two swings about one axis would be one angle under two names.
void RequireSwings(const Limb& limb) {
  const DegreeOfFreedom* first = nullptr;
  for (const DegreeOfFreedom& dof : limb.dofs) {
    if (dof.kind != DofKind::kSwing) continue;
    if (first != nullptr && first->axis.cross(dof.axis).norm() < kLeastSine) {
      Fail(limb.name, "angles", first->name + " and " + dof.name + " swing about the same axis");
    }
    first = &dof;
  }
}

void RequireJoint(const Limb& limb) {
  if (limb.parent < 0 && !limb.dofs.empty()) {
    Fail(limb.name, "angles",
         "is the base limb, which moves with the root and has no angles of its own");
  }
  if (limb.dofs.size() > 3) Fail(limb.name, "angles", "has more than three angles");
  int kinds[3] = {0, 0, 0};
  std::set<std::string> names;
  for (const DegreeOfFreedom& dof : limb.dofs) {
    RequireDof(limb, dof);
    ++kinds[static_cast<int>(dof.kind)];
    if (!names.insert(dof.name).second) Fail(limb.name, "angles", dof.name + " occurs twice");
  }
  const auto count = [&kinds](DofKind kind) { return kinds[static_cast<int>(kind)]; };
  if (count(DofKind::kSwing) > 0 && count(DofKind::kHinge) > 0) {
    Fail(limb.name, "angles", "mixes swings and hinges");
  }
  if (count(DofKind::kSwing) > 2 || count(DofKind::kTwist) > 1) {
    Fail(limb.name, "angles", "has more than two swings or one twist");
  }
  RequireSwings(limb);
}

}  // namespace

LimbFault::LimbFault(std::string limb, std::string key, const std::string& fault)
    : ConfigError("limb '" + limb + "': " + fault), limb_(std::move(limb)), key_(std::move(key)) {}

BodyModel::BodyModel(std::string name, std::vector<Limb> limbs)
    : name_(std::move(name)), limbs_(std::move(limbs)), children_(limbs_.size()) {
  RequireTree(limbs_);
  for (std::size_t i = 0; i < limbs_.size(); ++i) {
    const Limb& limb = limbs_[i];
    RequireShape(limb);
    RequireJoint(limb);
    first_angles_.push_back(angle_count_);
    angle_count_ += static_cast<int>(limb.dofs.size());
    if (limb.parent >= 0) {
      children_[static_cast<std::size_t>(limb.parent)].push_back(static_cast<int>(i));
    }
  }
  id_ = ContentHash(name_, limbs_);
}

std::optional<int> BodyModel::Find(std::string_view limb_name) const {
  const auto found = std::find_if(limbs_.begin(), limbs_.end(),
                                  [limb_name](const Limb& limb) { return limb.name == limb_name; });
  if (found == limbs_.end()) return std::nullopt;
  return static_cast<int>(found - limbs_.begin());
}

BodyPose RestPose(const BodyModel& model) {
  BodyPose pose;
  pose.angles_rad.resize(model.angle_count());
  int angle = 0;
  for (const Limb& limb : model.limbs()) {
    for (const DegreeOfFreedom& dof : limb.dofs) {
      pose.angles_rad[angle++] = std::clamp(0.0, dof.angle_min_rad, dof.angle_max_rad);
    }
  }
  return pose;
}

}  // namespace deixis::body_model
