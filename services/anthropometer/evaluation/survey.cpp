#include "services/anthropometer/evaluation/survey.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <optional>

#include "common/config/config.h"

namespace deixis::anthropometer {
namespace {

constexpr double kMetresPerMillimetre = 0.001;
const char* const kSubject = "subjectid";

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char letter : line) {
    if (letter == '\r') continue;
    if (letter == ',') {
      cells.emplace_back();
    } else {
      cells.back() += letter;
    }
  }
  return cells;
}

std::string LowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

/// Nothing of what is no number: surveys have words, too.
std::optional<double> Number(const std::string& text) {
  double number = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

}  // namespace

Survey Survey::Read(const std::filesystem::path& file) {
  const auto fail = [&file](int line, const std::string& fault) {
    throw config::ConfigError(file.string() + ":" + std::to_string(line) + ": " + fault);
  };
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line)) fail(1, "cannot be read; name a survey of ANSUR II");
  std::vector<std::string> names;
  for (const std::string& name : Cells(line)) names.push_back(LowerCase(name));
  const auto place = std::find(names.begin(), names.end(), kSubject);
  if (place == names.end()) fail(1, "has no column subjectid");
  Survey survey;
  survey.file_ = file;
  for (int number = 2; std::getline(in, line); ++number) {
    const std::vector<std::string> cells = Cells(line);
    if (cells.size() != names.size()) {
      fail(number, "has " + std::to_string(cells.size()) + " columns where the heading has " +
                       std::to_string(names.size()));
    }
    const auto subject = Number(cells[static_cast<std::size_t>(place - names.begin())]);
    if (!subject) fail(number, "has no subject's number");
    survey.subjects_.push_back(static_cast<int>(*subject));
    for (std::size_t i = 0; i < cells.size(); ++i) {
      survey.columns_[names[i]].push_back(Number(cells[i]).value_or(0.0));
    }
  }
  return survey;
}

double Survey::Measure_m(const anthropometry::BodyMeasure& measure, std::size_t person) const {
  double sum_mm = 0.0;
  for (const anthropometry::SurveyColumn& column : measure.ansur) {
    const auto found = columns_.find(column.of);
    if (found == columns_.end()) {
      throw config::ConfigError(file_.string() + ": has no column " + column.of + ", which " +
                                measure.name + " needs");
    }
    sum_mm += column.times * found->second[person];
  }
  return kMetresPerMillimetre * sum_mm;
}

}  // namespace deixis::anthropometer
