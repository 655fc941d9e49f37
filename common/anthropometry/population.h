#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/anthropometry/body_measures.h"

namespace deixis::anthropometry {

/// How measures vary together among the people of one sex: a normal distribution.
struct Population {
  Eigen::VectorXd mean_m;         ///< In the order of Populations::measures.
  Eigen::MatrixXd covariance_m2;  ///< Symmetric, positive definite.
};

/// Women and men by the same measures: a file that `scripts/deixis evaluate body` can write.
class Populations {
 public:
  /// Throws std::logic_error when sizes disagree. `offset_m`: see there; nothing for none.
  Populations(std::vector<std::string> measures, Population female, Population male,
              Eigen::VectorXd offset_m = {});

  /// Reads config/kinematics/population.yaml. Throws ConfigError naming file, line and key: counts
  /// that disagree, spreads that are not positive, correlations beyond -1..1 or that cannot be.
  static Populations Load(const std::filesystem::path& path);
  /// The text of such a file, lengths rounded to 0.1 mm. Load adds (2 mm)^2 to each variance.
  std::string ToYaml() const;

  const std::vector<std::string>& measures() const { return measures_; }
  std::optional<int> Find(const std::string& measure) const;
  /// One standard deviation of how people who are met differ from these on average, women and men
  /// alike: along this vector, metres, in the order of `measures`.
  const Eigen::VectorXd& offset_m() const { return offset_m_; }
  const Population& Of(Sex sex) const { return sex == Sex::kFemale ? female_ : male_; }

 private:
  std::vector<std::string> measures_;
  Population female_;
  Population male_;
  Eigen::VectorXd offset_m_;
};

}  // namespace deixis::anthropometry
