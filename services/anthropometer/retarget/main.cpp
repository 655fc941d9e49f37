// Reads a motion file into poses of a body model, tells what came of it, and writes them as BVH.
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "common/body_model/kinematics.h"
#include "common/config/config.h"
#include "common/motion/bvh.h"
#include "common/program/command_line.h"
#include "common/range_of_motion/range_of_motion.h"
#include "common/retargeting/to_clip.h"
#include "services/anthropometer/core/recording.h"

namespace deixis::anthropometer {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using retargeting::Retargeted;

struct Arguments {
  fs::path motion, bvh;
  motion::ClipOptions clip;
  std::string model = "whole_body_detailed";
};

Arguments Parse(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Reads a motion file into poses of a body model.", "deixis-retarget");
  app.set_version_flag("--version", "deixis-retarget " DEIXIS_VERSION);
  app.add_option("--motion", arguments.motion, "A .bvh file, or .amc with its .asf")->required();
  app.add_option("--asf", arguments.clip.asf, "Skeleton of an .amc file (default: beside it)");
  app.add_option("--amc-rate", arguments.clip.amc_frame_rate_hz,
                 "Frames per second of an .amc file")
      ->check(CLI::Range(1.0, 1000.0));
  app.add_option("--unit", arguments.clip.bvh.metres_per_unit, "Metres per unit of a .bvh file")
      ->check(CLI::Range(1e-6, 1000.0));
  app.add_option("--model", arguments.model, "A model of config/body_models");
  app.add_option("--bvh", arguments.bvh, "Write the poses to this file, centimetres");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? program::kStopped : program::kWrongCommand);
  }
  return arguments;
}

Json LimbsJson(const Retargeted& recording) {
  const body_model::BodyModel& model = recording.motion.model;
  Json limbs = Json::array();
  for (const retargeting::JointError& error : recording.errors) {
    const auto limb = static_cast<std::size_t>(*model.Find(error.limb));
    limbs.push_back(Json({{"limb", error.limb},
                          {"length_m", model.limbs()[limb].shape.length_m},
                          {"mean_error_m", error.mean_m},
                          {"largest_error_m", error.largest_m}}));
  }
  return limbs;
}

/// Frames of one joint beyond one limit.
struct Excess {
  int frames = 0;
  double worst_rad = 0.0;
};

Json LimitsJson(const Retargeted& recording) {
  const auto rows = anatomy::JointLimits::Load(config::FindConfig("kinematics/joint_limits.yaml"));
  const auto plan =
      range_of_motion::LoadRangePlan(config::FindConfig("kinematics/range_of_motion.yaml"), rows);
  const range_of_motion::RangeOfMotion ranges(recording.motion.model, plan, rows);
  body_model::Kinematics kinematics(recording.motion.model);
  std::vector<range_of_motion::JointState> states;
  std::map<std::pair<std::string, std::string>, Excess> beyond;
  for (const body_model::BodyPose& pose : recording.motion.poses) {
    kinematics.Update(pose);
    ranges.Check(kinematics, states);
    for (std::size_t i = 0; i < states.size(); ++i) {
      for (int k = 0; k < states[i].margins.count; ++k) {
        const range_of_motion::Margin& margin = states[i].margins.each[static_cast<std::size_t>(k)];
        if (margin.margin_rad > -1e-6) continue;
        Excess& excess = beyond[{ranges.joints()[i].Name(), *margin.motion}];
        ++excess.frames;
        excess.worst_rad = std::max(excess.worst_rad, -margin.margin_rad);
      }
    }
  }
  Json rows_beyond = Json::array();
  for (const auto& [cause, excess] : beyond) {
    rows_beyond.push_back(Json({{"joint", cause.first},
                                {"motion", cause.second},
                                {"frames", excess.frames},
                                {"worst_deg", excess.worst_rad * 180.0 / M_PI}}));
  }
  return rows_beyond;
}

Json Told(const Retargeted& recording) {
  Json at_rest = Json::array();
  for (const std::string& limb : recording.at_rest) at_rest.push_back(limb);
  return Json({{"model", recording.motion.model.name()},
               {"frames", recording.motion.poses.size()},
               {"frame_rate_hz", recording.motion.frame_rate_hz},
               {"limbs", LimbsJson(recording)},
               {"at_rest", at_rest},
               {"beyond_limits", LimitsJson(recording)}});
}

void Run(const Arguments& arguments) {
  const Retargeted recording =
      RecordingReader(arguments.model, arguments.clip).Read(arguments.motion);
  const Json told = Told(recording);
  if (!arguments.bvh.empty()) motion::WriteBvh(ToClip(recording.motion), arguments.bvh);
  std::cout << told.dump() << "\n";
  program::FinishOutput(std::cout);
}

}  // namespace
}  // namespace deixis::anthropometer

int main(int argc, char** argv) {
  try {
    deixis::anthropometer::Run(deixis::anthropometer::Parse(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "deixis-retarget: " << error.what() << "\n";
    return deixis::program::kCannotWork;
  }
  return deixis::program::kStopped;
}
