#pragma once
#include <string>
#include <vector>

#include "common/anthropometry/person_estimate.h"
#include "services/anthropometer/evaluation/population_fit.h"

namespace deixis::anthropometer {

/// How well unmeasured lengths follow from measured ones.
struct PredictionScore {
  std::string measure;
  double median_mm = 0.0;  ///< Of the absolute error.
  double p90_mm = 0.0;
  double p95_mm = 0.0;
  double stated_spread_mm = 0.0;  ///< Median of what the estimate states.
  double bias_mm = 0.0;           ///< Mean error: definitions and people that differ.
  double share_within_50 = 0.0;   ///< Of true values in the interval that should hold 50 %.
  double share_within_90 = 0.0;   ///< Of true values in the interval that should hold 90 %.
};

/// How well the sex follows from the same lengths: women and men weigh the same, however many.
struct SexScore {
  double accuracy = 0.0;           ///< Share of people whose sex is the likelier one.
  double sure_share = 0.0;         ///< Of people whose probability is above 0.9.
  double sure_accuracy = 0.0;      ///< Among these.
  double calibration_error = 0.0;  ///< Mean gap between stated probability and share, by tenths.
  double brier = 0.0;              ///< Mean squared error of the stated probability.
};

struct PopulationScore {
  std::vector<PredictionScore> predictions;
  SexScore sex;
  int people = 0;
};

/// Shows each person of that half of the survey by the lengths `given`, each with an error of that
/// standard deviation (drawn by a fixed seed), and compares all else with what was measured.
PopulationScore Score(const anthropometry::Populations& populations,
                      const anthropometry::BodyMeasures& measures, const Surveys& surveys,
                      Half half, const std::vector<std::string>& given, double error_m);

}  // namespace deixis::anthropometer
