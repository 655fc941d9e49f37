// Measures how well a person's sizes and sex follow from a few lengths, with people of a survey
// that the figures were not learned from; and writes the figures anew from the other half.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "common/config/config.h"
#include "common/program/command_line.h"
#include "services/anthropometer/evaluation/population_score.h"

namespace deixis::anthropometer {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path data;
  std::vector<std::string> given;
  double error_mm = 10.0;
  fs::path population;
};

Arguments Parse(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Measures what follows of a body's sizes from a few lengths.",
               "deixis-evaluate-body");
  app.set_version_flag("--version", "deixis-evaluate-body " DEIXIS_VERSION);
  app.add_option("--survey", arguments.data, "Folder with the tables of ANSUR II")->required();
  app.add_option("--given", arguments.given, "Measures that are known of a person (default: none)")
      ->delimiter(',');
  app.add_option("--error", arguments.error_mm, "Their standard deviation, millimetres")
      ->check(CLI::Range(0.1, 200.0));
  app.add_option("--write-population", arguments.population,
                 "Write the figures of the survey's odd half to this file, and stop");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? program::kStopped : program::kWrongCommand);
  }
  return arguments;
}

anthropometry::BodyMeasures ShippedMeasures() {
  return anthropometry::BodyMeasures::Load({config::FindConfig("kinematics/measures.yaml"),
                                            config::FindConfig("kinematics/measures_ansur2.yaml")});
}

void Write(const anthropometry::Populations& populations, const fs::path& file) {
  std::ofstream out(file);
  out << "# Joint distributions of body measures: means and spreads, millimetres, and "
         "correlations.\n"
         "# Written by `deixis-evaluate-body --write-population`. Correlations are those of the\n"
         "# people of ANSUR II with odd numbers. Means and spreads are those of measures.yaml "
         "where\n"
         "# it has them; those of measures_ansur2.yaml are the survey's, means moved to the mean\n"
         "# stature of measures.yaml by regression. offset_mm is the mean, over both sexes, of "
         "what\n"
         "# these means have more than the survey's: one standard deviation of how people differ "
         "from them.\n"
      << populations.ToYaml();
  if (!out.flush()) throw config::ConfigError(file.string() + ": cannot be written");
}

void Print(const PopulationScore& score, const std::vector<std::string>& given) {
  std::printf("measure,median_mm,p90_mm,p95_mm,stated_spread_mm,bias_mm,within_50,within_90\n");
  for (const PredictionScore& row : score.predictions) {
    std::printf("%s,%.1f,%.1f,%.1f,%.1f,%.1f,%.3f,%.3f\n", row.measure.c_str(), row.median_mm,
                row.p90_mm, row.p95_mm, row.stated_spread_mm, row.bias_mm, row.share_within_50,
                row.share_within_90);
  }
  std::string names;
  for (const std::string& name : given) names += (names.empty() ? "" : ";") + name;
  std::printf("\npeople,accuracy,sure_share,sure_accuracy,calibration_error,brier,given\n");
  std::printf("%d,%.4f,%.4f,%.4f,%.4f,%.4f,%s\n", score.people, score.sex.accuracy,
              score.sex.sure_share, score.sex.sure_accuracy, score.sex.calibration_error,
              score.sex.brier, names.c_str());
}

/// The abbreviations of measures that are named in any language.
std::vector<std::string> GivenOf(const std::vector<std::string>& names,
                                 const anthropometry::BodyMeasures& measures,
                                 const anthropometry::Populations& populations) {
  std::vector<std::string> given;
  for (const std::string& name : names) {
    const anthropometry::BodyMeasure* measure = measures.Find(name);
    if (measure == nullptr || !populations.Find(measure->name)) {
      std::string known;
      for (const std::string& one : populations.measures()) {
        known += (known.empty() ? "" : ", ") + one;
      }
      throw config::ConfigError("--given " + name +
                                " is no measure of kinematics/population.yaml: there are " + known);
    }
    if (std::find(given.begin(), given.end(), measure->name) != given.end()) {
      throw config::ConfigError("--given " + name + ": " + measure->name + " is given already");
    }
    given.push_back(measure->name);
  }
  return given;
}

void Run(const Arguments& arguments) {
  const auto measures = ShippedMeasures();
  const Surveys surveys{Survey::Read(arguments.data / "ANSUR_II_FEMALE_Public.csv"),
                        Survey::Read(arguments.data / "ANSUR_II_MALE_Public.csv")};
  if (!arguments.population.empty()) {
    Write(FitPopulations(measures, surveys, Half::kOdd), arguments.population);
    return;
  }
  const auto populations =
      anthropometry::Populations::Load(config::FindConfig("kinematics/population.yaml"));
  const auto given = GivenOf(arguments.given, measures, populations);
  Print(Score(populations, measures, surveys, Half::kEven, given, 0.001 * arguments.error_mm),
        given);
}

}  // namespace
}  // namespace deixis::anthropometer

int main(int argc, char** argv) {
  try {
    deixis::anthropometer::Run(deixis::anthropometer::Parse(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "deixis-evaluate-body: " << error.what() << "\n";
    return deixis::program::kCannotWork;
  }
  return deixis::program::kStopped;
}
