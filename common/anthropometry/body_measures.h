#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/anatomy/terms.h"

namespace deixis::anthropometry {

enum class Sex { kFemale, kMale };

inline auto EnumNames(Sex) {
  return std::vector<std::pair<std::string, Sex>>{{"female", Sex::kFemale}, {"male", Sex::kMale}};
}

/// How one measure spreads among the people of one sex, millimetres at percentiles.
struct Percentiles {
  double p1 = 0.0, p5 = 0.0, p50 = 0.0, p95 = 0.0, p99 = 0.0;
  double percent = 0.0;     ///< Share of the body height: mean of that at P1, P5, P50 and P95.
  double half_range = 0.0;  ///< Half the range of these four shares; no spread between people.

  /// Standard deviation between people, mm: that of the normal distribution through P5 and P95.
  double Spread_mm() const { return (p95 - p5) / 3.29; }
  /// By column: p1, p5, p50, p95, p99, percent, half_range. Throws std::logic_error for another.
  double Column(const std::string& name) const;
};

/// A value that the source prints and that contradicts others.
struct PrintedValue {
  Sex sex = Sex::kFemale;
  std::string column;
  double value = 0.0;
  std::string why;  ///< Where the corrected one comes from.
};

enum class MeasuringPosture { kStanding, kSitting };

inline auto EnumNames(MeasuringPosture) {
  return std::vector<std::pair<std::string, MeasuringPosture>>{
      {"standing", MeasuringPosture::kStanding}, {"sitting", MeasuringPosture::kSitting}};
}

/// A measure as a sum: of another measure, added or taken away.
struct Summand {
  std::string of;
  int sign = 1;  ///< 1 or -1.
};

/// A column of a survey, as part of a measure, millimetres.
struct SurveyColumn {
  std::string of;
  double times = 1.0;
};

/// One measure of the body.
struct BodyMeasure {
  std::string name;  ///< Abbreviation: kph, oal ...
  anatomy::Names names;
  std::string definition;  ///< English.
  MeasuringPosture posture = MeasuringPosture::kStanding;
  std::vector<Summand> derived;     ///< Empty = it is measured.
  std::vector<SurveyColumn> ansur;  ///< Columns of ANSUR II that sum up to it; empty = it has none.
  std::optional<Percentiles> female, male;  ///< Nothing: only derived, or only surveyed.
  std::vector<PrintedValue> printed;

  const std::optional<Percentiles>& Of(Sex sex) const {
    return sex == Sex::kFemale ? female : male;
  }
};

/// "Values of human kinematics", section 3: all measures; and what other surveys add.
class BodyMeasures {
 public:
  /// Reads config/kinematics/measures.yaml and files like it. Throws ConfigError naming file, line
  /// and key: names that occur twice, percentiles that do not grow, derived from what is no
  /// measure.
  static BodyMeasures Load(const std::vector<std::filesystem::path>& paths);

  const std::vector<BodyMeasure>& all() const { return all_; }
  /// By abbreviation or by its name in any language; nullptr when there is none.
  const BodyMeasure* Find(const std::string& name) const;

  /// Millimetres at the 50th percentile; of what is only derived the sum of its parts. Percentiles
  /// do not add up, so others are not derived. Throws std::logic_error for an unknown name, and for
  /// one of a survey.
  double Median_mm(const std::string& name, Sex sex) const;

 private:
  std::vector<BodyMeasure> all_;
};

}  // namespace deixis::anthropometry
