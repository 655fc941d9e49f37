#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/anthropometry/body_measures.h"

namespace deixis::anthropometer {

/// A survey's table: people by columns, ANSUR II's units (mostly millimetres).
class Survey {
 public:
  /// Reads comma-separated values with a heading, one column of which is the subject's number
  /// (subjectid, in either case). Throws ConfigError naming file, line and column.
  static Survey Read(const std::filesystem::path& file);

  std::size_t people() const { return subjects_.size(); }
  int subject(std::size_t person) const { return subjects_[person]; }
  /// A measure of one person, metres. Throws ConfigError naming a column that the survey lacks.
  double Measure_m(const anthropometry::BodyMeasure& measure, std::size_t person) const;

 private:
  std::filesystem::path file_;
  std::vector<int> subjects_;
  std::map<std::string, std::vector<double>> columns_;
};

}  // namespace deixis::anthropometer
