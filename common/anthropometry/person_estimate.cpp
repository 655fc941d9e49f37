#include "common/anthropometry/person_estimate.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace deixis::anthropometry {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const char* const kStature = "kph";
constexpr double kExact_m2 = 1e-8;

/// The lengths as linear observations of a population.
struct Observations {
  std::vector<int> places;
  VectorXd values_m;
  VectorXd variances_m2;
};

Observations Checked(const Populations& populations, const std::vector<MeasuredLength>& lengths) {
  const auto count = static_cast<Eigen::Index>(lengths.size());
  Observations observations{{}, VectorXd(count), VectorXd(count)};
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const MeasuredLength& length = lengths[i];
    const auto place = populations.Find(length.measure);
    if (!place)
      throw std::invalid_argument("no measure '" + length.measure + "' in the population");
    if (!(length.length_m > 0.0) || !std::isfinite(length.length_m) ||
        !(length.variance_m2 > 0.0) || !std::isfinite(length.variance_m2)) {
      throw std::invalid_argument("length and variance of '" + length.measure +
                                  "' must be positive");
    }
    observations.places.push_back(*place);
    observations.values_m[static_cast<Eigen::Index>(i)] = length.length_m;
    observations.variances_m2[static_cast<Eigen::Index>(i)] = length.variance_m2;
  }
  return observations;
}

/// A population once lengths are known, and how likely these were in it.
struct Conditioned {
  VectorXd mean_m;
  MatrixXd covariance_m2;
  double log_likelihood = 0.0;
};

Conditioned Condition(const Population& population, const Observations& observed) {
  const auto count = observed.values_m.size();
  if (count == 0) return {population.mean_m, population.covariance_m2, 0.0};
  MatrixXd across(population.mean_m.size(), count);
  VectorXd surprise_m(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int place = observed.places[static_cast<std::size_t>(i)];
    across.col(i) = population.covariance_m2.col(place);
    surprise_m[i] = observed.values_m[i] - population.mean_m[place];
  }
  MatrixXd innovation(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    innovation.row(i) = across.row(observed.places[static_cast<std::size_t>(i)]);
  }
  innovation.diagonal() += observed.variances_m2;
  const Eigen::LLT<MatrixXd> root(innovation);
  const VectorXd explained = root.solve(surprise_m);
  Conditioned result{population.mean_m + across * explained,
                     population.covariance_m2 - across * root.solve(across.transpose()), 0.0};
  const double log_root = MatrixXd(root.matrixL()).diagonal().array().log().sum();
  result.log_likelihood = -0.5 * surprise_m.dot(explained) - log_root;
  return result;
}

/// The people of that sex who may be met, wherever their average lies.
Population Met(const Populations& populations, Sex sex) {
  Population met = populations.Of(sex);
  met.covariance_m2 += populations.offset_m() * populations.offset_m().transpose();
  return met;
}

double Logistic(double x) { return 1.0 / (1.0 + std::exp(-x)); }

/// Share of the standard normal distribution below x.
double BelowNormal(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

}  // namespace

double PersonEstimate::Length_m(const std::string& measure) const {
  const auto found = std::find(measures.begin(), measures.end(), measure);
  if (found == measures.end()) throw std::invalid_argument("no measure '" + measure + "'");
  return mean_m[found - measures.begin()];
}

double PersonEstimate::Spread_m(const std::string& measure) const {
  const auto found = std::find(measures.begin(), measures.end(), measure);
  if (found == measures.end()) throw std::invalid_argument("no measure '" + measure + "'");
  const auto place = found - measures.begin();
  return std::sqrt(std::max(0.0, covariance_m2(place, place)));
}

std::map<std::string, double> PersonEstimate::Sizes_m() const {
  std::map<std::string, double> sizes_m;
  for (std::size_t i = 0; i < measures.size(); ++i) {
    sizes_m[measures[i]] = mean_m[static_cast<Eigen::Index>(i)];
  }
  return sizes_m;
}

PersonEstimate EstimatePerson(const Populations& populations,
                              const std::vector<MeasuredLength>& lengths, std::optional<Sex> sex) {
  const Observations observed = Checked(populations, lengths);
  const Conditioned female = Condition(Met(populations, Sex::kFemale), observed);
  const Conditioned male = Condition(Met(populations, Sex::kMale), observed);
  PersonEstimate estimate;
  estimate.measures = populations.measures();
  estimate.female_probability = sex ? (*sex == Sex::kFemale ? 1.0 : 0.0)
                                    : Logistic(female.log_likelihood - male.log_likelihood);
  const double p = estimate.female_probability;
  const VectorXd apart_m = female.mean_m - male.mean_m;
  estimate.mean_m = male.mean_m + p * apart_m;
  estimate.covariance_m2 = p * female.covariance_m2 + (1.0 - p) * male.covariance_m2 +
                           p * (1.0 - p) * apart_m * apart_m.transpose();
  return estimate;
}

double StatureAt(const Populations& populations, Sex sex, double share) {
  if (!(share > 0.0 && share < 1.0)) throw std::invalid_argument("share must lie in 0..1");
  const auto place = populations.Find(kStature);
  if (!place) throw std::invalid_argument("the population has no stature (kph)");
  const Population& population = populations.Of(sex);
  double low = -8.0, high = 8.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (BelowNormal(middle) < share ? low : high) = middle;
  }
  return population.mean_m[*place] + low * std::sqrt(population.covariance_m2(*place, *place));
}

std::map<std::string, double> SizesOf(const Populations& populations, Sex sex, double stature_m) {
  const Populations tables(populations.measures(), populations.Of(Sex::kFemale),
                           populations.Of(Sex::kMale));
  return EstimatePerson(tables, {{kStature, stature_m, kExact_m2}}, sex).Sizes_m();
}

}  // namespace deixis::anthropometry
