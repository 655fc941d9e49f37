// Runs the recogniser over recordings, many configurations and seeds in one process, and prints the
// events as CSV: column,seed,recording,scene,utime since the recording's start in seconds,hand
// side,outcome,object. Scoring is left to the front end.
#include <CLI/CLI.hpp>
#include <iostream>
#include <map>

#include "common/program/command_line.h"
#include "services/gesture_recogniser/evaluation/examples.h"
#include "services/gesture_recogniser/gesture_recogniser_service.h"

namespace deixis::gesture_recogniser {
namespace {

struct Arguments {
  std::filesystem::path recordings;
  std::filesystem::path training;  ///< Models are learned from here, the tested person left out.
  std::filesystem::path scenes;    ///< Objects of these are put into recordings without gestures.
  std::string config_file;
  std::vector<std::string> columns;
  std::vector<std::string> overrides;
  int seeds = 10;
  double noise_px = TrackNoise{}.sigma_px;
};

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

/// What is wrong with the settings of a column; empty when nothing is.
std::string ColumnFault(const std::string& text) {
  const auto colon = text.find(':');
  if (text.empty() || colon == 0) return "'" + text + "' has no name";
  if (colon == std::string::npos) return "";
  for (const std::string& setting : Split(text.substr(colon + 1), ',')) {
    const std::string fault = program::AssignmentFault(setting);
    if (!fault.empty()) return fault;
  }
  return "";
}

Arguments Parse(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Runs the gesture recogniser over recordings.", "deixis-evaluate-pointing");
  app.set_version_flag("--version", "deixis-evaluate-pointing " DEIXIS_VERSION);
  app.add_option("--recordings", arguments.recordings, "Folder of *.recording files")->required();
  app.add_option("--training", arguments.training,
                 "Learn models from this folder, each tested person left out");
  app.add_option("--scenes", arguments.scenes, "Put the objects of these into each recording");
  app.add_option("--config", arguments.config_file, "Configuration of the gesture recogniser")
      ->check(program::EmptyFault);
  app.add_option("--column", arguments.columns, "Column name:key=value,key=value...")
      ->check(ColumnFault);
  app.add_option("--set", arguments.overrides, "Override a key for all columns: key=value")
      ->check(program::AssignmentFault);
  app.add_option("--seeds", arguments.seeds, "How many runs with other noise")
      ->check(CLI::PositiveNumber);
  app.add_option("--noise-px", arguments.noise_px, "Noise added to true hand positions")
      ->check(CLI::NonNegativeNumber);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? program::kStopped : program::kWrongCommand);
  }
  return arguments;
}

struct Column {
  std::string name;
  GestureRecogniserServiceConfig config;
};

Column MakeColumn(const Arguments& arguments, const std::string& text) {
  const auto colon = text.find(':');
  std::vector<std::string> overrides = arguments.overrides;
  if (colon != std::string::npos) {
    for (const std::string& override : Split(text.substr(colon + 1), ',')) {
      overrides.push_back(override);
    }
  }
  const std::string file =
      arguments.config_file.empty() ? "gesture_recogniser.yaml" : arguments.config_file;
  return {text.substr(0, colon),
          config::Load<GestureRecogniserServiceConfig>(config::FindConfig(file), overrides)};
}

/// Models per person, learned without that person when there is something to learn from.
class Models {
 public:
  Models(const Arguments& arguments, const PointingRecogniserConfig& config,
         const std::vector<std::string>& names)
      : config_(config), shipped_(LoadModels(names)) {
    noise_.sigma_px = arguments.noise_px;
    noise_.seed = 1000;
    if (!arguments.training.empty()) training_ = ReadRecordings(arguments.training);
  }
  const std::vector<GestureModel>& For(const std::string& person) {
    if (training_.empty()) return shipped_;
    const auto known = learned_.find(person);
    if (known != learned_.end()) return known->second;
    return learned_
        .emplace(person, TrainModels(training_, person, noise_, config_.motion, config_.scale))
        .first->second;
  }

 private:
  PointingRecogniserConfig config_;
  TrackNoise noise_;
  std::vector<GestureModel> shipped_;
  std::vector<Recording> training_;
  std::map<std::string, std::vector<GestureModel>> learned_;
};

const char* Word(scene::Side side) {
  return side == scene::Side::kLeft ? "left" : side == scene::Side::kRight ? "right" : "unknown";
}

const char* Word(scene::GestureOutcome outcome) {
  switch (outcome) {
    case scene::GestureOutcome::kObject:
      return "object";
    case scene::GestureOutcome::kNoObject:
      return "no_object";
    case scene::GestureOutcome::kAmbiguous:
      return "ambiguous";
  }
  return "";
}

void Run(const Column& column, int seed, const Recording& recording, const Recording& scene,
         const std::vector<scene::Hands>& tracked, const std::vector<GestureModel>& models) {
  PointingRecogniserConfig config = column.config.recogniser;
  config.as_printed.seed += static_cast<std::uint64_t>(seed);
  PointingRecogniser recogniser(config, models);
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    recogniser.ObserveObjects(ObjectsAt(recording, recording.frames[i], scene.objects));
    for (const scene::Gesture& gesture : recogniser.ObserveHands(tracked[i]).gestures) {
      if (gesture.end.microseconds != 0) continue;
      std::cout << column.name << ',' << seed << ',' << recording.name << ',' << scene.name << ','
                << SecondsBetween(TimeOf(0.0), gesture.time) << ',' << Word(gesture.side) << ','
                << Word(gesture.outcome) << ',' << gesture.object_id << '\n';
    }
  }
}

void RunAll(const Arguments& arguments) {
  std::vector<Column> columns;
  if (arguments.columns.empty()) columns.push_back(MakeColumn(arguments, "default"));
  for (const std::string& text : arguments.columns) columns.push_back(MakeColumn(arguments, text));
  const std::vector<Recording> recordings = ReadRecordings(arguments.recordings);
  if (recordings.empty()) {
    throw config::ConfigError("folder '" + arguments.recordings.string() +
                              "' has no *.recording file; set --recordings to one that has");
  }
  std::vector<Recording> scenes;
  if (!arguments.scenes.empty()) scenes = ReadRecordings(arguments.scenes);
  Models models(arguments, columns.front().config.recogniser, columns.front().config.models);
  std::cout << "column,seed,recording,scene,time_s,side,outcome,object\n";
  for (int seed = 1; seed <= arguments.seeds; ++seed) {
    for (const Recording& recording : recordings) {
      TrackNoise noise;
      noise.sigma_px = arguments.noise_px;
      noise.seed = static_cast<std::uint64_t>(seed);
      const auto tracked = TrackedHands(recording, noise);
      for (const Column& column : columns) {
        const auto& known = models.For(recording.person);
        if (scenes.empty()) Run(column, seed, recording, recording, tracked, known);
        for (const Recording& scene : scenes) Run(column, seed, recording, scene, tracked, known);
      }
    }
  }
}

}  // namespace
}  // namespace deixis::gesture_recogniser

int main(int argc, char** argv) {
  try {
    deixis::gesture_recogniser::RunAll(deixis::gesture_recogniser::Parse(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "deixis-evaluate-pointing: " << error.what() << "\n";
    return deixis::program::kCannotWork;
  }
  return deixis::program::kStopped;
}
