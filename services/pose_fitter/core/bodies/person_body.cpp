#include "services/pose_fitter/core/bodies/person_body.h"

#include <vector>

#include "common/config/config.h"

namespace deixis::pose_fitter {
namespace {

constexpr const char* kBuild = "chest_breadth";  // Goes with all girths and breadths.

}  // namespace

BodyMaker::BodyMaker(const std::string& plan_file)
    : populations_(
          anthropometry::Populations::Load(config::FindConfig("kinematics/population.yaml"))),
      plan_(body_model::LoadBodyPlan(config::FindConfig(plan_file))) {}

PersonBody BodyMaker::Make(std::optional<double> stature_m, double sigma_m, double build) const {
  std::vector<anthropometry::MeasuredLength> lengths;
  if (stature_m) lengths.push_back({"kph", *stature_m, sigma_m * sigma_m});
  auto estimate = EstimatePerson(populations_, lengths);
  if (build != 0.0) {
    // As if it had been measured, half as exactly as people differ: what comes of it is `build`.
    const double spread_m = estimate.Spread_m(kBuild), error_m = 0.5 * spread_m;
    const double measured_m = estimate.Length_m(kBuild) + 1.25 * build * spread_m;
    lengths.push_back({kBuild, measured_m, error_m * error_m});
    estimate = EstimatePerson(populations_, lengths);
  }
  auto model = body_model::Build(plan_, estimate.Sizes_m());
  return {std::move(model), std::move(estimate)};
}

}  // namespace deixis::pose_fitter
