#include "services/anthropometer/evaluation/population_score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "common/config/config.h"

namespace deixis::anthropometer {
namespace {

using anthropometry::MeasuredLength;
using anthropometry::PersonEstimate;
using anthropometry::Sex;

constexpr double kWithin50 = 0.6745;  // Standard deviations.
constexpr double kWithin90 = 1.6449;  // Standard deviations.
constexpr double kSure = 0.9;
constexpr int kTenths = 10;

double Percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// What was found of one measure, person by person.
struct Errors {
  std::vector<double> absolute_mm, signed_mm, spread_mm;
  int within_50 = 0, within_90 = 0;

  PredictionScore Score(const std::string& measure) const {
    const auto count = static_cast<double>(absolute_mm.size());
    double sum_mm = 0.0;
    for (const double error_mm : signed_mm) sum_mm += error_mm;
    return {measure,
            Percentile(absolute_mm, 0.5),
            Percentile(absolute_mm, 0.9),
            Percentile(absolute_mm, 0.95),
            Percentile(spread_mm, 0.5),
            sum_mm / count,
            within_50 / count,
            within_90 / count};
  }
};

/// What was found of the sexes, person by person.
class SexErrors {
 public:
  void Add(double female_probability, Sex sex, double weight) {
    const double stated = std::max(female_probability, 1.0 - female_probability);
    const bool is_right = (female_probability > 0.5) == (sex == Sex::kFemale);
    people_ += weight;
    right_ += is_right ? weight : 0.0;
    sure_ += stated > kSure ? weight : 0.0;
    sure_right_ += stated > kSure && is_right ? weight : 0.0;
    const double gap = female_probability - (sex == Sex::kFemale ? 1.0 : 0.0);
    squared_ += weight * gap * gap;
    const int tenth = std::min(kTenths - 1, static_cast<int>(kTenths * female_probability));
    auto& bin = bins_[static_cast<std::size_t>(tenth)];
    bin.women += sex == Sex::kFemale ? weight : 0.0;
    bin.stated += weight * female_probability;
  }
  SexScore Score() const {
    SexScore score;
    score.accuracy = right_ / people_;
    score.sure_share = sure_ / people_;
    score.sure_accuracy = sure_ > 0.0 ? sure_right_ / sure_ : 0.0;
    for (const Bin& bin : bins_) score.calibration_error += std::abs(bin.stated - bin.women);
    score.calibration_error /= people_;
    score.brier = squared_ / people_;
    return score;
  }

 private:
  struct Bin {
    double women = 0.0, stated = 0.0;
  };
  double people_ = 0.0, right_ = 0.0, sure_ = 0.0, sure_right_ = 0.0, squared_ = 0.0;
  std::array<Bin, kTenths> bins_{};
};

void Note(const PersonEstimate& estimate, std::size_t place, double true_m, Errors& errors) {
  const auto i = static_cast<Eigen::Index>(place);
  const double error_mm = 1000.0 * (estimate.mean_m[i] - true_m);
  const double spread_mm = 1000.0 * std::sqrt(std::max(0.0, estimate.covariance_m2(i, i)));
  errors.absolute_mm.push_back(std::abs(error_mm));
  errors.signed_mm.push_back(error_mm);
  errors.spread_mm.push_back(spread_mm);
  errors.within_50 += std::abs(error_mm) <= kWithin50 * spread_mm ? 1 : 0;
  errors.within_90 += std::abs(error_mm) <= kWithin90 * spread_mm ? 1 : 0;
}

/// What makes the people of one sex weigh as much as those of the other.
double Weight(const Survey& survey, Half half) {
  int people = 0;
  for (std::size_t i = 0; i < survey.people(); ++i) people += IsIn(half, survey.subject(i)) ? 1 : 0;
  return people > 0 ? 1.0 / people : 0.0;
}

}  // namespace

PopulationScore Score(const anthropometry::Populations& populations,
                      const anthropometry::BodyMeasures& measures, const Surveys& surveys,
                      Half half, const std::vector<std::string>& given, double error_m) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, error_m);
  std::vector<Errors> errors(populations.measures().size());
  SexErrors sexes;
  PopulationScore score;
  for (const Sex sex : {Sex::kFemale, Sex::kMale}) {
    const Survey& survey = surveys.Of(sex);
    const double weight = Weight(survey, half);
    for (std::size_t person = 0; person < survey.people(); ++person) {
      if (!IsIn(half, survey.subject(person))) continue;
      std::vector<MeasuredLength> lengths;
      for (const std::string& name : given) {
        const double true_m = survey.Measure_m(*measures.Find(name), person);
        lengths.push_back({name, true_m + noise(random), error_m * error_m});
      }
      const PersonEstimate estimate = EstimatePerson(populations, lengths);
      sexes.Add(estimate.female_probability, sex, weight);
      ++score.people;
      for (std::size_t i = 0; i < errors.size(); ++i) {
        const auto* measure = measures.Find(populations.measures()[i]);
        Note(estimate, i, survey.Measure_m(*measure, person), errors[i]);
      }
    }
  }
  if (score.people == 0) throw config::ConfigError("the survey has no such people");
  for (std::size_t i = 0; i < errors.size(); ++i) {
    score.predictions.push_back(errors[i].Score(populations.measures()[i]));
  }
  score.sex = sexes.Score();
  return score;
}

}  // namespace deixis::anthropometer
