// Averages labelled examples of pointing gestures into the motion models approach and rest.
#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>

#include "services/gesture_recogniser/core/pointing_recogniser.h"
#include "services/gesture_recogniser/evaluation/examples.h"

namespace {

void Write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  using namespace deixis::gesture_recogniser;
  CLI::App app("Averages labelled gestures into motion models.", "deixis-train-gestures");
  std::filesystem::path recordings;
  std::filesystem::path output;
  std::string without_person;
  TrackNoise noise;
  app.add_option("--recordings", recordings, "Folder of *.recording files")->required();
  app.add_option("--output", output, "Folder for <model>.yaml")->required();
  app.add_option("--exclude-person", without_person, "Leave this person's recordings out");
  app.add_option("--noise-px", noise.sigma_px, "Noise added to true hand positions, pixels");
  CLI11_PARSE(app, argc, argv);
  try {
    const PointingRecogniserConfig config;
    const auto models =
        TrainModels(ReadRecordings(recordings), without_person, noise, config.motion, config.scale);
    std::filesystem::create_directories(output);
    for (const GestureModel& model : models) {
      Write(output / (model.name + ".yaml"), ToYaml(model));
      std::cout << model.name << ": " << model.examples << " examples\n";
    }
  } catch (const std::exception& error) {
    std::cerr << "deixis-train-gestures: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
