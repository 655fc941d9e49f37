// Lists, as CSV, all that the tracker takes for possible hands in the pictures of a log (channels
// of its configuration; faces must be in the log): what the weights of its likelihood are learned
// from.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <optional>

#include "common/messages/image.h"
#include "common/messages/objects.h"
#include "common/program/command_line.h"
#include "services/hand_tracker/hand_tracker_service.h"

namespace deixis::hand_tracker {
namespace {

struct Arguments {
  std::filesystem::path log;
  std::string config_file = "hand_tracker.yaml";
  std::vector<std::string> overrides;
};

Arguments Parse(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Lists the candidates for hands in a log's pictures as CSV.",
               "deixis-list-hand-candidates");
  app.set_version_flag("--version", "deixis-list-hand-candidates " DEIXIS_VERSION);
  app.add_option("log", arguments.log, "Log with pictures and faces")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--config", arguments.config_file, "Configuration of the hand tracker");
  app.add_option("--set", arguments.overrides, "Override a key: key=value");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? program::kStopped : program::kWrongCommand);
  }
  return arguments;
}

void PrintHeading() {
  std::cout << "image,time_s,hand_length_px,u,v";
  for (const char* name : NamesOfLooks()) std::cout << ',' << name;
  std::cout << '\n';
}

/// One line per candidate, and one with number and time alone for the image itself.
void Print(int image, double time_s, const Observation& observation) {
  std::cout << image << ',' << time_s << '\n';
  for (const HandCandidate& candidate : observation.candidates) {
    std::cout << image << ',' << time_s << ',' << candidate.hand_length_px << ','
              << candidate.centre.x() << ',' << candidate.centre.y();
    for (const double value : LooksOf(candidate)) std::cout << ',' << value;
    std::cout << '\n';
  }
}

void List(const Arguments& arguments) {
  const auto config = config::Load<HandTrackerServiceConfig>(
      config::FindConfig(arguments.config_file), arguments.overrides);
  transport::BusOptions options;
  options.url = "file://" + std::filesystem::absolute(arguments.log).string() + "?speed=0";
  options.deliver_every_message = true;
  transport::Bus bus(options);
  HandTracker tracker(config.tracker);
  int image = 0;
  std::optional<Timestamp> begin;
  bus.Subscribe<scene::Objects>(
      config.objects_channel, transport::Delivery::kEvery,
      [&tracker](const scene::Objects& objects) { tracker.UpdateFaces(objects); });
  bus.Subscribe<images::Image>(
      config.image_channel, transport::Delivery::kEvery, [&](const images::Image& picture) {
        tracker.Track(picture);
        if (!begin) begin = picture.time;
        Print(image++, SecondsBetween(*begin, picture.time), tracker.observation());
      });
  PrintHeading();
  while (!bus.is_exhausted()) bus.Handle(std::chrono::milliseconds(100));
  if (image == 0) {
    throw std::runtime_error(arguments.log.string() + " has no pictures on " +
                             config.image_channel);
  }
}

}  // namespace
}  // namespace deixis::hand_tracker

int main(int argc, char** argv) {
  using namespace deixis::hand_tracker;
  try {
    List(Parse(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "deixis-list-hand-candidates: " << error.what() << "\n";
    return deixis::program::kCannotWork;
  }
  return deixis::program::kStopped;
}
