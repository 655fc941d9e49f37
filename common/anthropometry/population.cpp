#include "common/anthropometry/population.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <stdexcept>
#include <utility>

#include "common/config/config.h"

namespace deixis::anthropometry {
namespace {

// Nobody is measured better: keeps measures that are sums of others from being quite certain.
constexpr double kLeastSpread_m = 0.002;
constexpr double kMetresPerMillimetre = 0.001;

struct PopulationEntry {
  std::vector<double> mean_mm, spread_mm;
  std::vector<std::vector<double>> correlation;  ///< Row by row, up to the diagonal.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("mean_mm", mean_mm);
    v("spread_mm", spread_mm);
    v("correlation", correlation);
  }
  void Validate() const {
    config::Faults faults;
    const auto is_length = [](double mm) { return mm > 0.0 && mm < 3000.0; };
    faults.Require(std::all_of(mean_mm.begin(), mean_mm.end(), is_length), "mean_mm",
                   "must lie in 0..3000");
    faults.Require(std::all_of(spread_mm.begin(), spread_mm.end(), is_length), "spread_mm",
                   "must lie in 0..3000");
    faults.Require(spread_mm.size() == mean_mm.size(), "spread_mm", "must be as many as mean_mm");
    faults.Require(correlation.size() == mean_mm.size(), "correlation",
                   "must have a row for each mean_mm");
    for (std::size_t i = 0; i < correlation.size(); ++i) {
      faults.Require(correlation[i].size() == i + 1, "correlation[" + std::to_string(i) + "]",
                     "must have " + std::to_string(i + 1) + " values");
      for (const double value : correlation[i]) {
        faults.Require(value >= -1.0 && value <= 1.0, "correlation[" + std::to_string(i) + "]",
                       "must lie in -1..1");
      }
    }
    faults.ThrowIfAny();
  }
  Population ToPopulation() const {
    const auto size = static_cast<Eigen::Index>(mean_mm.size());
    Population population{
        kMetresPerMillimetre * Eigen::Map<const Eigen::VectorXd>(mean_mm.data(), size),
        Eigen::MatrixXd(size, size)};
    for (std::size_t i = 0; i < mean_mm.size(); ++i) {
      for (std::size_t k = 0; k <= i; ++k) {
        const double covariance_m2 = correlation[i][k] * spread_mm[i] * spread_mm[k] *
                                     kMetresPerMillimetre * kMetresPerMillimetre;
        const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(k);
        population.covariance_m2(row, column) = covariance_m2;
        population.covariance_m2(column, row) = covariance_m2;
      }
    }
    population.covariance_m2.diagonal().array() += kLeastSpread_m * kLeastSpread_m;
    return population;
  }
};

struct PopulationsFile {
  std::vector<std::string> measures;
  std::vector<double> offset_mm;
  PopulationEntry female, male;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("measures", measures);
    v("offset_mm", offset_mm);
    v("female", female);
    v("male", male);
  }
  void Validate() const {
    config::Faults faults;
    faults.Require(!measures.empty(), "measures", "must name a measure");
    faults.Require(
        std::set<std::string>(measures.begin(), measures.end()).size() == measures.size(),
        "measures", "must name each measure once");
    faults.Require(offset_mm.empty() || offset_mm.size() == measures.size(), "offset_mm",
                   "must be as many as measures, or none");
    faults.Require(std::all_of(offset_mm.begin(), offset_mm.end(),
                               [](double mm) { return std::abs(mm) < 1000.0; }),
                   "offset_mm", "must lie in -1000..1000");
    faults.Require(female.mean_mm.size() == measures.size(), "female.mean_mm",
                   "must be as many as measures");
    faults.Require(male.mean_mm.size() == measures.size(), "male.mean_mm",
                   "must be as many as measures");
    for (const auto& [key, entry] : {std::pair{"female", &female}, std::pair{"male", &male}}) {
      if (entry->correlation.size() != entry->mean_mm.size()) continue;
      const Eigen::LLT<Eigen::MatrixXd> root(entry->ToPopulation().covariance_m2);
      faults.Require(root.info() == Eigen::Success, std::string(key) + ".correlation",
                     "cannot be one of anything: it is not positive definite");
    }
    faults.ThrowIfAny();
  }
};

std::string Number(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string Row(const char* format, const Eigen::VectorXd& values) {
  std::string row;
  for (const double value : values) row += (row.empty() ? "" : ", ") + Number(format, value);
  return "[" + row + "]";
}

std::string ToYaml(const Population& population) {
  const Eigen::VectorXd spread_m = population.covariance_m2.diagonal().cwiseSqrt();
  std::string text = "  mean_mm: " + Row("%.1f", 1000.0 * population.mean_m) + "\n";
  text += "  spread_mm: " + Row("%.1f", 1000.0 * spread_m) + "\n  correlation:\n";
  for (Eigen::Index i = 0; i < spread_m.size(); ++i) {
    Eigen::VectorXd row = population.covariance_m2.row(i).head(i + 1).transpose();
    row = row.cwiseQuotient(spread_m[i] * spread_m.head(i + 1));
    row[i] = 1.0;
    text += "    - " + Row("%.5f", row) + "\n";
  }
  return text;
}

bool IsOf(const Population& population, std::size_t measures) {
  const auto size = static_cast<Eigen::Index>(measures);
  return population.mean_m.size() == size && population.covariance_m2.rows() == size &&
         population.covariance_m2.cols() == size;
}

}  // namespace

Populations::Populations(std::vector<std::string> measures, Population female, Population male,
                         Eigen::VectorXd offset_m)
    : measures_(std::move(measures)),
      female_(std::move(female)),
      male_(std::move(male)),
      offset_m_(std::move(offset_m)) {
  const auto size = static_cast<Eigen::Index>(measures_.size());
  if (offset_m_.size() == 0) offset_m_ = Eigen::VectorXd::Zero(size);
  if (!IsOf(female_, measures_.size()) || !IsOf(male_, measures_.size()) ||
      offset_m_.size() != size) {
    throw std::logic_error("Populations: not of " + std::to_string(measures_.size()) + " measures");
  }
}

Populations Populations::Load(const std::filesystem::path& path) {
  const auto file = config::Load<PopulationsFile>(path);
  const Eigen::Map<const Eigen::VectorXd> offset_mm(
      file.offset_mm.data(), static_cast<Eigen::Index>(file.offset_mm.size()));
  return {file.measures, file.female.ToPopulation(), file.male.ToPopulation(),
          kMetresPerMillimetre * offset_mm};
}

std::string Populations::ToYaml() const {
  std::string names;
  for (const std::string& measure : measures_) names += (names.empty() ? "" : ", ") + measure;
  return "measures: [" + names + "]\noffset_mm: " + Row("%.1f", 1000.0 * offset_m_) +
         "\nfemale:\n" + anthropometry::ToYaml(female_) + "male:\n" + anthropometry::ToYaml(male_);
}

std::optional<int> Populations::Find(const std::string& measure) const {
  const auto found = std::find(measures_.begin(), measures_.end(), measure);
  if (found == measures_.end()) return std::nullopt;
  return static_cast<int>(found - measures_.begin());
}

}  // namespace deixis::anthropometry
