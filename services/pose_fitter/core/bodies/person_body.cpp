#include "services/pose_fitter/core/bodies/person_body.h"

#include <vector>

#include "common/config/config.h"

namespace deixis::pose_fitter {

BodyMaker::BodyMaker(const std::string& plan_file)
    : populations_(
          anthropometry::Populations::Load(config::FindConfig("kinematics/population.yaml"))),
      plan_(body_model::LoadBodyPlan(config::FindConfig(plan_file))) {}

PersonBody BodyMaker::Make(std::optional<double> stature_m, double sigma_m) const {
  std::vector<anthropometry::MeasuredLength> lengths;
  if (stature_m) lengths.push_back({"kph", *stature_m, sigma_m * sigma_m});
  auto estimate = EstimatePerson(populations_, lengths);
  auto model = body_model::Build(plan_, estimate.Sizes_m());
  return {std::move(model), std::move(estimate)};
}

}  // namespace deixis::pose_fitter
