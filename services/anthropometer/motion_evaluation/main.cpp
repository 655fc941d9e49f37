// Measures what limits of joints say of recorded motion of real people, and derives limits of
// speed from one person's recordings.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <set>

#include "common/config/config.h"
#include "common/program/command_line.h"
#include "services/anthropometer/core/recording.h"
#include "services/anthropometer/motion_evaluation/motion_score.h"
#include "services/anthropometer/motion_evaluation/speed_score.h"

namespace deixis::anthropometer {
namespace {

namespace fs = std::filesystem;
using range_of_motion::Limits;

constexpr double kReserve = 2.0;

struct Arguments {
  fs::path data;
  std::string actor;
  std::string model = "whole_body_detailed";
  std::string limits = "default";
  std::string allowances;
  double amc_rate_hz = 120.0;
  fs::path speeds;
};

Arguments Parse(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Measures what limits of joints say of recorded motion.", "deixis-evaluate-motion");
  app.set_version_flag("--version", "deixis-evaluate-motion " DEIXIS_VERSION);
  app.add_option("--recordings", arguments.data, "Folder with .bvh files, or .amc with .asf")
      ->required();
  app.add_option("--actor", arguments.actor,
                 "Only recordings of this person: the skeleton's name, as HDM_bd");
  app.add_option("--model", arguments.model, "A model of config/body_models");
  app.add_option("--limits", arguments.limits, "Which limits judge: source or default")
      ->check(CLI::IsMember({"source", "default"}));
  app.add_option("--allowances-of", arguments.allowances,
                 "Judge by the source's limits, widened by what this person's recordings need");
  app.add_option("--amc-rate", arguments.amc_rate_hz, "Frames per second of .amc files")
      ->check(CLI::Range(1.0, 1000.0));
  app.add_option("--write-speeds", arguments.speeds,
                 "Write limits of speed from these recordings to this file, and stop")
      ->needs("--actor");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? program::kStopped : program::kWrongCommand);
  }
  return arguments;
}

/// The recordings of one person; of all when `actor` is empty.
std::vector<fs::path> FilesOf(const fs::path& data, const std::string& actor) {
  std::vector<fs::path> files;
  std::set<std::string> actors;
  for (const fs::path& file : FindMotionFiles(data)) {
    const std::string found = ActorOf(file);
    if (actor.empty() || found == actor) files.push_back(file);
    actors.insert(found);
  }
  if (!files.empty()) return files;
  std::string names;
  for (const std::string& name : actors) names += (names.empty() ? "" : ", ") + name;
  throw config::ConfigError("'" + actor + "' is none of those recorded: " + names);
}

std::string Joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ";") + name;
  return text;
}

/// As RFC 4180 has it: files may have commas and quotes in their names.
std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char letter : text) quoted += letter == '"' ? "\"\"" : std::string(1, letter);
  return quoted + "\"";
}

void Print(const MotionScore& score) {
  std::printf("joint,joint_frames,rejected\n");
  for (const auto& [name, joint] : score.joints) {
    std::printf("%s,%ld,%ld\n", name.c_str(), joint.joint_frames, joint.rejected);
  }
  std::printf("faulty,%ld,%ld\n", score.faulty.joint_frames, score.faulty.rejected);
  std::printf("\njoint,motion,rejected,worst_deg\n");
  for (const auto& [cause, counted] : score.causes) {
    std::printf("%s,%s,%ld,%.1f\n", cause.first.c_str(), cause.second.c_str(), counted.rejected,
                counted.worst_deg);
  }
  std::printf("\nrecording,frames,joint_frames,rejected,mean_error_mm,largest_error_mm,faulty\n");
  for (const ClipScore& clip : score.clips) {
    std::printf("%s,%ld,%ld,%ld,%.2f,%.2f,%s\n", Quoted(clip.name).c_str(), clip.frames,
                clip.joint_frames, clip.rejected, 1000.0 * clip.mean_error_m,
                1000.0 * clip.largest_error_m, Joined(clip.faulty).c_str());
  }
}

void Print(const std::vector<SpeedScore>& scores) {
  std::printf("\njoint,samples,too_fast,too_sudden,fastest_deg_per_s,most_sudden_deg_per_s2\n");
  for (const SpeedScore& score : scores) {
    std::printf("%s,%ld,%.6f,%.6f,%.0f,%.0f\n", score.joint.c_str(), score.samples, score.too_fast,
                score.too_sudden, score.fastest_deg_per_s, score.most_sudden_deg_per_s2);
  }
}

void WriteSpeeds(const SpeedSamples& samples, const Arguments& arguments, std::size_t files) {
  std::ofstream out(arguments.speeds);
  out << "# Limits of angular speed and acceleration of joints. Written by\n"
         "# `deixis-evaluate-motion --write-speeds`; the source names these limits without "
         "values.\n"
         "# Both are those of the joint's limbs together, over 1/30 s.\n"
      << "derived_from: motion capture of one person (" << arguments.actor << "), " << files
      << " takes; twice what all but one of 1000 samples keep to\n"
      << "certainty: low. Everyday motion and quick reaches of one person; sprints, hard throws "
         "and\n"
         "  falls are faster, so what is faster is unusual, not impossible\n"
      << "joints:\n";
  for (const range_of_motion::JointSpeed& limit : LimitsFrom(samples, kReserve)) {
    out << "  - {joint: " << limit.joint << ", speed_deg_per_s: " << limit.speed_deg_per_s
        << ", acceleration_deg_per_s2: " << limit.acceleration_deg_per_s2 << "}\n";
  }
  if (!out.flush()) throw config::ConfigError(arguments.speeds.string() + ": cannot be written");
}

MotionScore ScoreOf(const std::vector<fs::path>& files, const RecordingReader& reader,
                    const Judges& judges) {
  MotionScore score;
  for (const fs::path& file : files) {
    AddClip(file.filename().string(), reader.Read(file), judges, score);
  }
  return score;
}

SpeedSamples SpeedsOf(const std::vector<fs::path>& files, const RecordingReader& reader,
                      const Judges& judges) {
  SpeedSamples speeds;
  for (const fs::path& file : files) {
    const auto recording = reader.Read(file);
    try {
      AddSpeeds(recording.motion, judges, speeds);
    } catch (const std::invalid_argument& error) {
      throw config::ConfigError(file.string() + ": " + error.what());
    }
  }
  return speeds;
}

void Run(const Arguments& arguments) {
  const auto rows = anatomy::JointLimits::Load(config::FindConfig("kinematics/joint_limits.yaml"));
  auto plan =
      range_of_motion::LoadRangePlan(config::FindConfig("kinematics/range_of_motion.yaml"), rows);
  motion::ClipOptions options;
  options.amc_frame_rate_hz = arguments.amc_rate_hz;
  const RecordingReader reader(arguments.model, options);
  if (!arguments.allowances.empty()) {
    const auto files = FilesOf(arguments.data, arguments.allowances);
    plan = WithAllowancesFor(ScoreOf(files, reader, {plan, rows, Limits::kSource}), plan);
  }
  const Judges judges{plan, rows,
                      arguments.limits == "source" ? Limits::kSource : Limits::kDefault};
  const auto files = FilesOf(arguments.data, arguments.actor);
  const SpeedSamples speeds = SpeedsOf(files, reader, judges);
  if (!arguments.speeds.empty()) {
    WriteSpeeds(speeds, arguments, files.size());
    return;
  }
  Print(ScoreOf(files, reader, judges));
  Print(ScoreSpeeds(speeds, range_of_motion::LoadSpeedLimits(
                                config::FindConfig("kinematics/joint_speeds.yaml"))));
}

}  // namespace
}  // namespace deixis::anthropometer

int main(int argc, char** argv) {
  try {
    deixis::anthropometer::Run(deixis::anthropometer::Parse(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "deixis-evaluate-motion: " << error.what() << "\n";
    return deixis::program::kCannotWork;
  }
  return deixis::program::kStopped;
}
