#pragma once
#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/anthropometry/population.h"

namespace deixis::anthropometry {

/// A length of one person, measured with an error.
struct MeasuredLength {
  std::string measure;       ///< Abbreviation.
  double length_m = 0.0;     ///< Positive.
  double variance_m2 = 0.0;  ///< Positive.
};

/// What is known of one person's sizes: mean and covariance in the order of `measures`.
struct PersonEstimate {
  double female_probability = 0.5;  ///< Never a fact.
  std::vector<std::string> measures;
  Eigen::VectorXd mean_m;
  Eigen::MatrixXd covariance_m2;

  /// Throws std::invalid_argument for a measure that the population lacks.
  double Length_m(const std::string& measure) const;
  double Spread_m(const std::string& measure) const;
  /// All means, by measure.
  std::map<std::string, double> Sizes_m() const;
};

/// From any lengths, none too, to stature, sex and every other measure: normal distributions per
/// sex, conditioned on what was measured, weighed by how well they explain it. Assumes as many
/// women as men; errors of the lengths that are normal and independent; and people whose average
/// may differ from the tables' along Populations::offset_m by an unknown share, normal with
/// variance 1 and the same for both sexes, which is marginalised: absolute size says less of the
/// sex than proportions do. With `sex` only that one counts. Throws std::invalid_argument for a
/// measure that the population lacks or lengths that are none.
PersonEstimate EstimatePerson(const Populations& populations,
                              const std::vector<MeasuredLength>& lengths,
                              std::optional<Sex> sex = std::nullopt);

/// The stature, metres, that a share of the people of one sex does not exceed, 0 < share < 1.
double StatureAt(const Populations& populations, Sex sex, double share);

/// The usual sizes, metres by measure, of people of one sex and of that stature, as the tables have
/// them: without Populations::offset_m.
std::map<std::string, double> SizesOf(const Populations& populations, Sex sex, double stature_m);

}  // namespace deixis::anthropometry
