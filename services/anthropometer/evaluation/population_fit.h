#pragma once
#include "common/anthropometry/population.h"
#include "services/anthropometer/evaluation/survey.h"

namespace deixis::anthropometer {

/// People of a survey by their number: some to learn from, the others to test with.
enum class Half { kOdd, kEven };

bool IsIn(Half half, int subject);

/// Surveys of both sexes.
struct Surveys {
  Survey female;
  Survey male;
  const Survey& Of(anthropometry::Sex sex) const {
    return sex == anthropometry::Sex::kFemale ? female : male;
  }
};

/// Joint distributions of all measures that the survey has. Correlations are those of half of its
/// people. Means and spreads of what has percentiles are those, of the others the survey's: their
/// means moved to the mean stature of the percentiles by regression, since the people of a survey
/// may be of another size. The offset is the mean of both sexes' differences from the survey.
anthropometry::Populations FitPopulations(const anthropometry::BodyMeasures& measures,
                                          const Surveys& surveys, Half half);

}  // namespace deixis::anthropometer
