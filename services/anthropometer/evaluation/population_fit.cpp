#include "services/anthropometer/evaluation/population_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/config/config.h"

namespace deixis::anthropometer {
namespace {

using anthropometry::BodyMeasure;
using anthropometry::Population;
using anthropometry::Sex;

constexpr double kMetresPerMillimetre = 0.001;
const char* const kStature = "kph";

/// People by measures, metres.
Eigen::MatrixXd Table(const std::vector<const BodyMeasure*>& measures, const Survey& survey,
                      Half half) {
  std::vector<std::size_t> people;
  for (std::size_t i = 0; i < survey.people(); ++i) {
    if (IsIn(half, survey.subject(i))) people.push_back(i);
  }
  if (people.size() < 2) throw config::ConfigError("the survey has fewer than two such people");
  Eigen::MatrixXd table(static_cast<Eigen::Index>(people.size()),
                        static_cast<Eigen::Index>(measures.size()));
  for (std::size_t i = 0; i < people.size(); ++i) {
    for (std::size_t k = 0; k < measures.size(); ++k) {
      table(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          survey.Measure_m(*measures[k], people[i]);
    }
  }
  return table;
}

/// Moves all means by regression to where the tables have the mean stature.
void MoveToTheTables(const std::vector<const BodyMeasure*>& measures, Sex sex, Population& fit) {
  const auto stature =
      std::find_if(measures.begin(), measures.end(),
                   [](const BodyMeasure* measure) { return measure->name == kStature; });
  if (stature == measures.end() || !(*stature)->Of(sex)) return;
  const auto place = stature - measures.begin();
  const double taller_m = kMetresPerMillimetre * (*stature)->Of(sex)->p50 - fit.mean_m[place];
  fit.mean_m += fit.covariance_m2.col(place) / fit.covariance_m2(place, place) * taller_m;
}

/// Of one sex: its distribution, and how far its means are from the survey's.
struct SexFit {
  Population population;
  Eigen::VectorXd moved_m;
};

SexFit Fit(const std::vector<const BodyMeasure*>& measures, const Survey& survey, Sex sex,
           Half half) {
  const Eigen::MatrixXd table = Table(measures, survey, half);
  const Eigen::VectorXd surveyed_m = table.colwise().mean().transpose();
  const Eigen::MatrixXd centred = table.rowwise() - surveyed_m.transpose();
  Population fit{surveyed_m, centred.transpose() * centred / static_cast<double>(table.rows() - 1)};
  MoveToTheTables(measures, sex, fit);
  for (std::size_t k = 0; k < measures.size(); ++k) {
    const auto& percentiles = measures[k]->Of(sex);
    if (!percentiles) continue;
    const auto place = static_cast<Eigen::Index>(k);
    const double scale = kMetresPerMillimetre * percentiles->Spread_mm() /
                         std::sqrt(fit.covariance_m2(place, place));
    fit.covariance_m2.row(place) *= scale;
    fit.covariance_m2.col(place) *= scale;
    fit.mean_m[place] = kMetresPerMillimetre * percentiles->p50;
  }
  return {fit, fit.mean_m - surveyed_m};
}

}  // namespace

bool IsIn(Half half, int subject) { return (subject % 2 != 0) == (half == Half::kOdd); }

anthropometry::Populations FitPopulations(const anthropometry::BodyMeasures& measures,
                                          const Surveys& surveys, Half half) {
  std::vector<const BodyMeasure*> surveyed;
  std::vector<std::string> names;
  for (const BodyMeasure& measure : measures.all()) {
    if (measure.ansur.empty() || (!measure.derived.empty() && !measure.female)) continue;
    surveyed.push_back(&measure);
    names.push_back(measure.name);
  }
  const SexFit female = Fit(surveyed, surveys.female, Sex::kFemale, half);
  const SexFit male = Fit(surveyed, surveys.male, Sex::kMale, half);
  return {names, female.population, male.population, 0.5 * (female.moved_m + male.moved_m)};
}

}  // namespace deixis::anthropometer
