// Measures what limits of joints say of recorded motion of real people, and derives limits of
// speed from one person's recordings.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "common/config/config.h"
#include "common/program/command_line.h"
#include "services/anthropometer/motion_evaluation/motion_score.h"
#include "services/anthropometer/motion_evaluation/recordings.h"
#include "services/anthropometer/motion_evaluation/speed_score.h"

namespace deixis::anthropometer {
namespace {

namespace fs = std::filesystem;
using range_of_motion::Limits;

constexpr double kReserve = 1.5;

struct Arguments {
  fs::path data;
  std::string actor;
  std::string model = "whole_body_detailed";
  std::string limits = "default";
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
  app.add_option("--amc-rate", arguments.amc_rate_hz, "Frames per second of .amc files")
      ->check(CLI::Range(1.0, 1000.0));
  app.add_option("--write-speeds", arguments.speeds,
                 "Write limits of speed from these recordings to this file, and stop");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? program::kStopped : program::kWrongCommand);
  }
  return arguments;
}

std::vector<fs::path> FilesOf(const Arguments& arguments) {
  std::vector<fs::path> files;
  std::string actors;
  for (const fs::path& file : FindMotionFiles(arguments.data)) {
    const std::string actor = ActorOf(file);
    if (arguments.actor.empty() || actor == arguments.actor) files.push_back(file);
    if (actors.find(actor) == std::string::npos) actors += (actors.empty() ? "" : ", ") + actor;
  }
  if (files.empty()) {
    throw config::ConfigError("--actor " + arguments.actor + " is none of: " + actors);
  }
  return files;
}

void Print(const MotionScore& score) {
  std::printf("joint,joint_frames,rejected,worst_deg,causes\n");
  for (const auto& [name, joint] : score.joints) {
    std::string causes;
    for (const auto& [motion, count] : joint.by_motion) {
      causes += (causes.empty() ? "" : ";") + motion + "=" + std::to_string(count);
    }
    std::printf("%s,%ld,%ld,%.1f,%s\n", name.c_str(), joint.joint_frames, joint.rejected,
                joint.worst_deg, causes.c_str());
  }
  std::printf("\nrecording,frames,joint_frames,rejected,mean_error_mm,largest_error_mm\n");
  for (const ClipScore& clip : score.clips) {
    std::printf("%s,%ld,%ld,%ld,%.2f,%.2f\n", clip.name.c_str(), clip.frames, clip.joint_frames,
                clip.rejected, 1000.0 * clip.mean_error_m, 1000.0 * clip.largest_error_m);
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
      << " takes; 1.5 times what all but one of 1000 samples keep to\n"
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

void Run(const Arguments& arguments) {
  const auto rows = anatomy::JointLimits::Load(config::FindConfig("kinematics/joint_limits.yaml"));
  const auto plan =
      range_of_motion::LoadRangePlan(config::FindConfig("kinematics/range_of_motion.yaml"));
  const RecordingReader reader(arguments.model, arguments.amc_rate_hz);
  const Limits limits = arguments.limits == "source" ? Limits::kSource : Limits::kDefault;
  MotionScore score;
  SpeedSamples speeds;
  const auto files = FilesOf(arguments);
  for (const fs::path& file : files) {
    const retargeting::Retargeted recording = reader.Read(file);
    AddClip(file.filename().string(), recording, plan, rows, limits, score);
    AddSpeeds(recording.motion, plan, rows, speeds);
  }
  if (!arguments.speeds.empty()) {
    WriteSpeeds(speeds, arguments, files.size());
    return;
  }
  Print(score);
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
