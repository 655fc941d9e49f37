#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "common/anthropometry/person_estimate.h"
#include "common/body_model/body_model.h"
#include "common/body_model/body_plan.h"

namespace deixis::pose_fitter {

/// One number by which people of the same plan differ, left and right alike: what it changes of a
/// body, as a factor (1 + value), or as metres that are added.
struct ShapeParameter {
  std::string name;        ///< stature, trunk_length, upper_arm_length, leg_girth ...
  bool is_offset = false;  ///< Metres.
  double sigma = 0.0;      ///< One standard deviation between people, in the value's unit.
};

/// How people may differ from one body: parameters with their prior, mean 0 and independent.
class ShapeParameters {
 public:
  /// Those that `model` has limbs for. `estimate` is what `model` was built from with `plan`: it
  /// says how sure the stature is. Of the others the spreads of the plan's terms count, and those
  /// that measures have among people of one stature; the larger one, since the first are few
  /// people's and the second have no clothes.
  ShapeParameters(const body_model::BodyModel& model, const body_model::BodyPlan& plan,
                  const anthropometry::PersonEstimate& estimate);

  const std::vector<ShapeParameter>& all() const { return all_; }
  int count() const { return static_cast<int>(all_.size()); }
  /// -1 = none of that name.
  int Find(const std::string& name) const;
  const body_model::BodyModel& model() const { return model_; }

  /// The body with these values. Throws LimbFault when it is none (a length below zero).
  body_model::BodyModel Apply(const Eigen::VectorXd& values) const;

 private:
  /// A length of a limb that a parameter changes.
  struct Field {
    int limb = 0;
    std::string key;  ///< As ForEachLength has it.
  };

  body_model::BodyModel model_;
  std::vector<ShapeParameter> all_;
  std::vector<std::vector<Field>> fields_;  ///< Of each parameter; the first one's are all.
};

}  // namespace deixis::pose_fitter
