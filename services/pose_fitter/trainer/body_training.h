#pragma once
#include <map>
#include <string>
#include <vector>

#include "common/anthropometry/population.h"
#include "services/pose_fitter/trainer/clothed_plan.h"
#include "services/pose_fitter/trainer/limb_surface.h"
#include "services/pose_fitter/trainer/share_choice.h"

namespace deixis::pose_fitter {

/// How sure the stature that is given of somebody is.
inline constexpr double kStatureSigma_m = 0.005;

/// What is learned from one person.
struct TrainedPerson {
  std::string id;
  double stature_m = 0.0;
  body_model::Sizes by_stature;
  body_model::Sizes by_stature_and_sex;
  Lengths tree;     ///< Joint places and limb lengths.
  Lengths surface;  ///< Semi-axes and centres; those of limbs that were hardly seen are missing.
  std::vector<PosedSurface> frames;
  double joint_error_m = 0.0;  ///< Mean distance of true joints from those of its model.
};

/// Reads joints, poses and surface points of one person's sequences; no surface yet.
TrainedPerson ReadPerson(const std::vector<RenderedPerson>& sequences,
                         const body_model::BodyPlan& plan,
                         const anthropometry::Populations& populations);

/// Fits the surface of a person, starting from `plan`'s shapes.
void FitSurface(const body_model::BodyPlan& plan, TrainedPerson& person);

/// How one length of the plan follows from measures.
struct LearnedLength {
  std::string name;  ///< "thigh.origin.y".
  LengthShare share;
};

/// Shares of all lengths that differ from zero in some person.
std::vector<LearnedLength> LearnShares(const std::vector<TrainedPerson>& people);

/// `plan` with these shares.
body_model::BodyPlan WithShares(const body_model::BodyPlan& plan,
                                const std::vector<LearnedLength>& learned);

/// A person with joints of its own and the surface as the plan has it.
body_model::BodyModel OnOwnJoints(const body_model::BodyPlan& plan, const TrainedPerson& person);

}  // namespace deixis::pose_fitter
