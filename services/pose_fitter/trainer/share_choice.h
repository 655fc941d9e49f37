#pragma once
#include <string>
#include <vector>

#include "common/body_model/body_plan.h"

namespace deixis::pose_fitter {

/// One length of one person, and what is expected of a person of this stature, sex not known and
/// known.
struct LengthSample {
  double length_m = 0.0;
  body_model::Sizes by_stature;
  body_model::Sizes by_stature_and_sex;
};

/// A length as a share of a measure, learned from people.
struct LengthShare {
  body_model::Term term;  ///< With its spread between people of the same stature and sex.
  /// Root mean square error for the one person that was left out each time, metres.
  double error_by_stature_m = 0.0;
  double error_by_stature_and_sex_m = 0.0;
};

/// The share of that measure which suits all people best, by least squares.
LengthShare FitShare(const std::vector<LengthSample>& people, const std::string& measure);

/// That of the candidates whose errors are smallest; the first one unless another is better by more
/// than a tenth, since few people say little. Needs at least two people.
LengthShare ChooseShare(const std::vector<LengthSample>& people,
                        const std::vector<std::string>& candidates);

/// Measures that a length may be a share of, the stature first: by limb and key of the plan.
std::vector<std::string> CandidatesFor(const std::string& limb, const std::string& key);

}  // namespace deixis::pose_fitter
