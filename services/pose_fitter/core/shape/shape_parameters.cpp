#include "services/pose_fitter/core/shape/shape_parameters.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;
using body_model::BodyPlan;
using body_model::LengthPlan;
using body_model::Limb;
using body_model::LimbPlan;
using body_model::Term;

constexpr double kUnknownShare = 0.06;      // Spread of a length of which the plan says nothing.
constexpr double kUnknownOffset_m = 0.015;  // Likewise.
constexpr double kLeastShare = 0.01;        // Nobody is known better.

/// Limbs without their side, and the keys of their lengths.
struct Group {
  const char* name;
  bool is_offset;
  std::vector<std::string> lengths;
};

const std::vector<Group>& Groups() {
  static const std::vector<Group> groups = {
      {"stature", false, {}},
      {"trunk_length",
       false,
       {"pelvis.length", "abdomen.origin.z", "abdomen.length", "chest.origin.z", "chest.length",
        "neck_base.origin.z", "neck_base.length", "neck.origin.z", "clavicle.origin.z"}},
      {"neck_length", false, {"neck.length", "head.origin.z"}},
      {"shoulder_width", false, {"clavicle.length", "upper_arm.origin.z", "deltoid.origin.z"}},
      {"hip_width", false, {"thigh.origin.y"}},
      {"upper_arm_length", false, {"upper_arm.length", "lower_arm.origin.z"}},
      {"lower_arm_length", false, {"lower_arm.length", "hand.origin.z"}},
      {"hand_length", false, {"hand.length"}},
      {"thigh_length", false, {"thigh.length", "shank.origin.z"}},
      {"shank_length", false, {"shank.length", "foot.origin.z"}},
      {"head_size",
       false,
       {"head.length", "head.proximal.a", "head.proximal.b", "head.distal.a", "head.distal.b",
        "jaw.length", "jaw.proximal.a", "jaw.proximal.b", "jaw.distal.a", "jaw.distal.b",
        "skull_cap.origin.z", "skull_cap.length", "skull_cap.proximal.a", "skull_cap.proximal.b",
        "skull_cap.distal.a", "skull_cap.distal.b"}},
      {"trunk_breadth",
       false,
       {"pelvis.proximal.b", "pelvis.distal.b", "abdomen.proximal.b", "abdomen.distal.b",
        "chest.proximal.b", "chest.distal.b"}},
      {"trunk_depth",
       false,
       {"pelvis.proximal.a", "pelvis.distal.a", "abdomen.proximal.a", "abdomen.distal.a",
        "chest.proximal.a", "chest.distal.a"}},
      {"trunk_forward",
       true,
       {"pelvis.proximal.x", "pelvis.distal.x", "abdomen.proximal.x", "abdomen.distal.x",
        "chest.proximal.x", "chest.distal.x"}},
      {"arm_girth",
       false,
       {"upper_arm.proximal.a", "upper_arm.proximal.b", "upper_arm.distal.a", "upper_arm.distal.b",
        "lower_arm.proximal.a", "lower_arm.proximal.b", "lower_arm.distal.a",
        "lower_arm.distal.b"}},
      {"leg_girth",
       false,
       {"thigh.proximal.a", "thigh.proximal.b", "thigh.distal.a", "thigh.distal.b",
        "shank.proximal.a", "shank.proximal.b", "shank.distal.a", "shank.distal.b"}}};
  return groups;
}

const std::vector<std::string>& AllKeys() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> all;
    const LimbPlan limb;
    body_model::ForEachLength(limb,
                              [&all](const char* key, const LengthPlan&) { all.push_back(key); });
    return all;
  }();
  return keys;
}

std::string WithoutSide(const std::string& limb) {
  for (const std::string side : {"right_", "left_"}) {
    if (limb.rfind(side, 0) == 0) return limb.substr(side.size());
  }
  return limb;
}

double& Value(Limb& limb, const std::string& key) {
  auto& origin_m = limb.rest_in_parent.translation_m;
  auto& shape = limb.shape;
  const std::pair<const char*, double*> values[] = {{"origin.x", &origin_m.x()},
                                                    {"origin.y", &origin_m.y()},
                                                    {"origin.z", &origin_m.z()},
                                                    {"length", &shape.length_m},
                                                    {"proximal.a", &shape.a0_m},
                                                    {"proximal.b", &shape.b0_m},
                                                    {"proximal.x", &shape.centre0_m.x()},
                                                    {"proximal.y", &shape.centre0_m.y()},
                                                    {"distal.a", &shape.a1_m},
                                                    {"distal.b", &shape.b1_m},
                                                    {"distal.x", &shape.centre1_m.x()},
                                                    {"distal.y", &shape.centre1_m.y()}};
  for (const auto& [name, value] : values) {
    if (key == name) return *value;
  }
  throw std::logic_error("no length " + key);
}

/// Variance of a measure among people of one stature.
double VarianceAtStature_m2(const anthropometry::PersonEstimate& estimate,
                            const std::string& measure) {
  const auto place = [&estimate](const std::string& name) {
    const auto found = std::find(estimate.measures.begin(), estimate.measures.end(), name);
    if (found == estimate.measures.end()) throw std::invalid_argument("no measure " + name);
    return found - estimate.measures.begin();
  };
  const auto i = place(measure), k = place("kph");
  const Eigen::MatrixXd& covariance = estimate.covariance_m2;
  return std::max(0.0, covariance(i, i) - covariance(i, k) * covariance(i, k) / covariance(k, k));
}

struct Spread {
  double length_m = 0.0;
  double sigma_m = 0.0;  ///< 0 = not known.
};

Spread SpreadOf(const LengthPlan& plan, const anthropometry::PersonEstimate& estimate) {
  double length_m = 0.0, by_plan_m2 = 0.0, by_measures_m2 = 0.0;
  for (const Term& term : plan) {
    const double unit_m = term.of.empty() ? 1.0 : estimate.Length_m(term.of);
    const double count = term.of.empty() ? term.metres : term.share;
    length_m += count * unit_m;
    by_plan_m2 += std::pow(term.spread * unit_m, 2);
    if (!term.of.empty()) {
      by_measures_m2 += term.share * term.share * VarianceAtStature_m2(estimate, term.of);
    }
  }
  return {length_m, std::sqrt(std::max(by_plan_m2, by_measures_m2))};
}

/// Of the lengths of a group that the plan has.
double SigmaOf(const Group& group, const BodyPlan& plan,
               const anthropometry::PersonEstimate& estimate) {
  double sum = 0.0;
  int count = 0;
  for (const LimbPlan& limb : plan.limbs) {
    body_model::ForEachLength(limb, [&](const char* key, const LengthPlan& length) {
      const std::string name = limb.name + "." + key;
      if (std::count(group.lengths.begin(), group.lengths.end(), name) == 0) return;
      const Spread spread = SpreadOf(length, estimate);
      if (spread.sigma_m == 0.0) return;
      const double unit_m = group.is_offset ? 1.0 : spread.length_m;
      sum += std::pow(spread.sigma_m / unit_m, 2);
      ++count;
    });
  }
  if (count == 0) return group.is_offset ? kUnknownOffset_m : kUnknownShare;
  const double sigma = std::sqrt(sum / count);
  return group.is_offset ? sigma : std::max(sigma, kLeastShare);
}

}  // namespace

ShapeParameters::ShapeParameters(const BodyModel& model, const BodyPlan& plan,
                                 const anthropometry::PersonEstimate& estimate)
    : model_(model) {
  for (const Group& group : Groups()) {
    const bool is_all = group.lengths.empty();
    std::vector<Field> fields;
    for (int limb = 0; limb < model.limb_count(); ++limb) {
      const std::string name = WithoutSide(model.limbs()[static_cast<std::size_t>(limb)].name);
      for (const std::string& key : AllKeys()) {
        const std::string length = name + "." + key;
        if (is_all || std::count(group.lengths.begin(), group.lengths.end(), length) != 0) {
          fields.push_back({limb, key});
        }
      }
    }
    if (fields.empty()) continue;
    const double stature = estimate.Spread_m("kph") / estimate.Length_m("kph");
    all_.push_back(
        {group.name, group.is_offset, is_all ? stature : SigmaOf(group, plan, estimate)});
    fields_.push_back(std::move(fields));
  }
  FindChanges();
}

void ShapeParameters::FindChanges() {
  changes_.setConstant(count(), model_.limb_count(), false);
  for (Eigen::Index k = 0; k < count(); ++k) {
    for (const Field& field : fields_[static_cast<std::size_t>(k)]) changes_(k, field.limb) = true;
    for (Eigen::Index limb = 1; limb < changes_.cols(); ++limb) {
      const int parent = model_.limbs()[static_cast<std::size_t>(limb)].parent;
      changes_(k, limb) = changes_(k, limb) || changes_(k, parent);
    }
  }
}

int ShapeParameters::Find(const std::string& name) const {
  for (std::size_t i = 0; i < all_.size(); ++i) {
    if (all_[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

BodyModel ShapeParameters::Apply(const Eigen::VectorXd& values) const {
  if (values.size() != count()) throw std::logic_error("ShapeParameters: wrong number of values");
  std::vector<Limb> limbs = model_.limbs();
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const double value = values[static_cast<Eigen::Index>(i)];
    for (const Field& field : fields_[i]) {
      double& length_m = Value(limbs[static_cast<std::size_t>(field.limb)], field.key);
      if (all_[i].is_offset) {
        length_m += value;
      } else {
        length_m *= 1.0 + value;
      }
    }
  }
  return {model_.name(), std::move(limbs)};
}

}  // namespace deixis::pose_fitter
