#pragma once
#include <memory>
#include <optional>
#include <string>

#include "common/anthropometry/person_estimate.h"
#include "common/anthropometry/population.h"
#include "common/body_model/body_plan.h"

namespace deixis::pose_fitter {

/// The body of one person, and what its sizes rest on.
struct PersonBody {
  body_model::BodyModel model;
  anthropometry::PersonEstimate estimate;
};

/// Makes bodies of people of whom not more than the stature is known.
class BodyMaker {
 public:
  /// Reads the plan (a file of config/body_models) and the population. Throws ConfigError.
  explicit BodyMaker(const std::string& plan_file);

  const body_model::BodyPlan& plan() const { return plan_; }
  /// Of a person of that stature, give or take `sigma_m`; nothing = of anybody. `build`: how much
  /// broader than others of that stature, in standard deviations.
  PersonBody Make(std::optional<double> stature_m, double sigma_m, double build = 0.0) const;

 private:
  anthropometry::Populations populations_;
  body_model::BodyPlan plan_;
};

}  // namespace deixis::pose_fitter
