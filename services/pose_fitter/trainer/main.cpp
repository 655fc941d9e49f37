// Learns the clothed body, config/body_models/clothed_body.yaml, from rendered people with truth.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>

#include "common/config/config.h"
#include "common/program/command_line.h"
#include "services/pose_fitter/trainer/body_training.h"
#include "services/pose_fitter/trainer/calibration_score.h"

namespace deixis::pose_fitter {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::vector<fs::path> sequences;
  fs::path output;
  std::string left_out;
};

Arguments Parse(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Learns joints and surfaces of clothed people from rendered sequences.",
               "deixis-train-body");
  app.set_version_flag("--version", "deixis-train-body " DEIXIS_VERSION);
  app.add_option("sequences", arguments.sequences, "Folders with joints.csv, depth and mask")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("--output", arguments.output, "File to write")->required();
  app.add_option("--leave-out", arguments.left_out, "Person, by the id of person.csv");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? program::kStopped : program::kWrongCommand);
  }
  return arguments;
}

std::vector<TrainedPerson> ReadPeople(const Arguments& arguments, const body_model::BodyPlan& plan,
                                      const anthropometry::Populations& populations) {
  std::map<std::string, std::vector<RenderedPerson>> sequences;
  for (const fs::path& folder : arguments.sequences) {
    RenderedPerson sequence = ReadRenderedPerson(folder);
    if (sequence.id != arguments.left_out) {
      sequences[sequence.id].push_back(std::move(sequence));
    }
  }
  if (sequences.size() < 2) throw config::ConfigError("at least two people are needed");
  std::vector<TrainedPerson> people;
  for (const auto& [id, all] : sequences) people.push_back(ReadPerson(all, plan, populations));
  return people;
}

std::string Millimetres(double length_m) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << 1000.0 * length_m;
  return text.str();
}

void PrintLengths(const std::vector<LearnedLength>& learned) {
  std::cout << "length,measure,share,spread,error_by_stature_mm,error_by_stature_and_sex_mm\n";
  for (const LearnedLength& one : learned) {
    std::cout << one.name << ',' << one.share.term.of << ',' << one.share.term.share << ','
              << one.share.term.spread << ',' << Millimetres(one.share.error_by_stature_m) << ','
              << Millimetres(one.share.error_by_stature_and_sex_m) << '\n';
  }
}

std::string Text(const SurfaceError& error) {
  std::ostringstream text;
  text << Millimetres(error.rms_m) << ',' << std::fixed << std::setprecision(3) << error.explained;
  return text.str();
}

/// What is learned without that person.
body_model::BodyPlan PlanOfOthers(const body_model::BodyPlan& plan,
                                  const std::vector<TrainedPerson>& people, const std::string& id) {
  std::vector<TrainedPerson> others;
  for (const TrainedPerson& other : people) {
    if (other.id != id) others.push_back(other);
  }
  return WithShares(plan, LearnShares(others));
}

void PrintSurfaces(const body_model::BodyPlan& plan, const std::vector<TrainedPerson>& people) {
  std::cout << "person,frames,points,joint_error_mm,hand_made_rms_mm,hand_made_explained,"
               "own_rms_mm,own_explained,others_rms_mm,others_explained\n";
  for (const TrainedPerson& person : people) {
    const auto error = [&person](const body_model::BodyPlan& shaped) {
      return MeasureSurface(OnOwnJoints(shaped, person), person.frames);
    };
    const SurfaceError own = error(WithLengths(plan, person.surface));
    std::cout << person.id << ',' << person.frames.size() << ',' << own.points << ','
              << Millimetres(person.joint_error_m) << ',' << Text(error(plan)) << ',' << Text(own)
              << ',' << Text(error(PlanOfOthers(plan, people, person.id))) << '\n';
  }
}

void PrintErrors(const std::map<std::string, double>& errors_m, double rms_m) {
  for (const auto& [limb, error_m] : errors_m) std::cout << ',' << Millimetres(error_m);
  std::cout << ',' << Millimetres(rms_m) << '\n';
}

void PrintCalibrations(const body_model::BodyPlan& plan, const std::vector<TrainedPerson>& people,
                       const anthropometry::Populations& populations) {
  std::cout << "calibrated_person,frames,lengths,clavicle_error_mm,lower_arm_error_mm,"
               "shank_error_mm,thigh_error_mm,upper_arm_error_mm,surface_rms_mm\n";
  for (const TrainedPerson& person : people) {
    const CalibrationScore score =
        ScoreCalibration(PlanOfOthers(plan, people, person.id), person, populations);
    const std::string who = person.id + "," + std::to_string(score.frames);
    std::cout << who << ",expected";
    PrintErrors(score.expected_error_m, score.expected_rms_m);
    if (score.is_refused) continue;
    std::cout << who << ",calibrated";
    PrintErrors(score.calibrated_error_m, score.calibrated_rms_m);
  }
}

std::string Heading(const std::vector<TrainedPerson>& people, const std::string& left_out) {
  std::size_t frames = 0;
  for (const TrainedPerson& person : people) frames += person.frames.size();
  std::ostringstream text;
  text << "# Clothed people as a camera sees them: joints and surfaces. Written by "
          "deixis-train-body,\n"
          "# learned from "
       << people.size() << " rendered people (" << frames << " frames with true depth"
       << (left_out.empty() ? "" : ", without " + left_out)
       << "); angles and\n"
          "# envelopes are those of whole_body_detailed. `spread`: between these people, one "
          "standard\n"
          "# deviation. Keys, frames and angles: README.md of this folder.\n";
  return text.str();
}

void Train(const Arguments& arguments) {
  const auto plan = ClothedPlan(
      body_model::LoadBodyPlan(config::FindConfig("body_models/whole_body_detailed.yaml")));
  const auto populations =
      anthropometry::Populations::Load(config::FindConfig("kinematics/population.yaml"));
  std::vector<TrainedPerson> people = ReadPeople(arguments, plan, populations);
  for (TrainedPerson& person : people) FitSurface(plan, person);
  const auto learned = LearnShares(people);
  PrintLengths(learned);
  if (people.size() > 2) {
    PrintSurfaces(plan, people);
    PrintCalibrations(plan, people, populations);
  }
  std::ofstream out(arguments.output);
  out << Heading(people, arguments.left_out) << body_model::ToYaml(WithShares(plan, learned));
  out.close();
  if (!out) throw config::ConfigError(arguments.output.string() + ": cannot be written");
}

}  // namespace
}  // namespace deixis::pose_fitter

int main(int argc, char** argv) {
  using namespace deixis::pose_fitter;
  try {
    Train(Parse(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "deixis-train-body: " << error.what() << "\n";
    return deixis::program::kCannotWork;
  }
  return deixis::program::kStopped;
}
