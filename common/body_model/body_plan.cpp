#include "common/body_model/body_plan.h"

#include <Eigen/Core>
#include <cmath>
#include <set>

#include "common/config/config.h"
#include "common/config/plain_text.h"

namespace deixis::body_model {
namespace {

bool IsDirection(const std::vector<double>& values) {
  return values.size() == 3 && Eigen::Vector3d(values[0], values[1], values[2]).norm() > 1e-3;
}

}  // namespace

void Term::Validate() const {
  config::Faults faults;
  faults.Require(of.empty() || metres == 0.0, "metres", "must not stand beside a measure");
  faults.Require(std::isfinite(share) && std::abs(share) <= 10.0, "share", "must lie in -10..10");
  faults.Require(std::isfinite(metres) && std::abs(metres) <= BodyModel::kLargest_m, "metres",
                 "must lie in -3..3");
  faults.Require(spread >= 0.0 && spread <= 10.0, "spread", "must lie in 0..10");
  faults.ThrowIfAny();
}

void AnglePlan::Validate() const {
  config::Faults faults;
  faults.Require(!name.empty(), "name", "must not be empty");
  faults.Require(IsDirection(axis), "axis", "must be three numbers, not all zero");
  faults.Require(min_deg >= -360.0 && min_deg <= 360.0, "min_deg", "must lie in -360..360");
  faults.Require(max_deg >= min_deg && max_deg <= 360.0, "max_deg",
                 "must lie between min_deg and 360");
  // Rest and standing poses have zeros, which must be within the limits.
  faults.Require(min_deg <= 0.0, "min_deg", "must not be above 0, where the limb rests");
  faults.Require(max_deg >= 0.0, "max_deg", "must not be below 0, where the limb rests");
  faults.ThrowIfAny();
}

void LimbPlan::Validate() const {
  config::Faults faults;
  faults.Require(config::IsPlainText(name) && !name.empty(), "name", config::kPlainTextRule);
  const bool is_base = parent.empty();
  faults.Require(is_base || IsDirection(rest_z), "rest_z", "must be three numbers, not all zero");
  faults.Require(is_base || IsDirection(rest_x), "rest_x", "must be three numbers, not all zero");
  faults.Require(!is_base || side == Side::kOnce, "side", "must be once of the base limb");
  faults.ThrowIfAny();
}

void BodyPlan::Validate() const {
  config::Faults faults;
  faults.Require(!limbs.empty(), "limbs", "must have a limb");
  faults.ThrowIfAny();
}

BodyPlan LoadBodyPlan(const std::filesystem::path& path) { return config::Load<BodyPlan>(path); }

std::vector<std::string> MeasuresOf(const BodyPlan& plan) {
  std::set<std::string> measures;
  for (const LimbPlan& limb : plan.limbs) {
    ForEachLength(limb, [&measures](const char*, const LengthPlan& length) {
      for (const Term& term : length) {
        if (!term.of.empty()) measures.insert(term.of);
      }
    });
  }
  return {measures.begin(), measures.end()};
}

}  // namespace deixis::body_model
