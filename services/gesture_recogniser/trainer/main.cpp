// Averages labelled examples of pointing gestures into two motion models: the gesture's stroke, and
// rest.
#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>

#include "common/program/command_line.h"
#include "services/gesture_recogniser/core/pointing_recogniser.h"
#include "services/gesture_recogniser/evaluation/examples.h"

namespace deixis::gesture_recogniser {
namespace {

struct Arguments {
  std::filesystem::path recordings;
  std::filesystem::path output;
  std::string name;
  std::string without_person;
  TrackNoise noise;
};

Arguments Parse(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Averages labelled gestures into motion models.", "deixis-train-gestures");
  app.set_version_flag("--version", "deixis-train-gestures " DEIXIS_VERSION);
  app.add_option("--recordings", arguments.recordings, "Folder of *.recording files")->required();
  app.add_option("--output", arguments.output, "Folder for <name>.yaml and rest.yaml")->required();
  app.add_option("--name", arguments.name, "Name of the gesture's model (default: approach)");
  app.add_option("--exclude-person", arguments.without_person, "Leave this person's out");
  app.add_option("--noise-px", arguments.noise.sigma_px,
                 "Noise added to true hand positions, pixels");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? program::kStopped : program::kWrongCommand);
  }
  return arguments;
}

void Write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

void Train(const Arguments& arguments) {
  const PointingRecogniserConfig config;
  auto models = TrainModels(ReadRecordings(arguments.recordings), arguments.without_person,
                            arguments.noise, config.motion, config.scale);
  if (!arguments.name.empty()) models.front().name = arguments.name;
  if (models.front().name == models.back().name) {
    throw std::runtime_error("--name " + arguments.name + " is the name of the other model");
  }
  std::filesystem::create_directories(arguments.output);
  for (const GestureModel& model : models) {
    Write(arguments.output / (model.name + ".yaml"), ToYaml(model));
    std::cout << model.name << ": " << model.examples << " examples\n";
  }
}

}  // namespace
}  // namespace deixis::gesture_recogniser

int main(int argc, char** argv) {
  using namespace deixis::gesture_recogniser;
  try {
    Train(Parse(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "deixis-train-gestures: " << error.what() << "\n";
    return deixis::program::kCannotWork;
  }
  return deixis::program::kStopped;
}
