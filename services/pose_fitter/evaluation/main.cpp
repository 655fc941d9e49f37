// Finds people and floor in sequences whose truth is known, and prints how well: a JSON object per
// sequence, and one of all.
#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "common/program/command_line.h"
#include "services/pose_fitter/core/depth/sound_depth.h"
#include "services/pose_fitter/core/floor/floor_tracker.h"
#include "services/pose_fitter/evaluation/people_score.h"

namespace deixis::pose_fitter {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::vector<fs::path> sequences;
  fs::path logs;
  fs::path pictures;
  int width_px = 320;
};

Arguments Parse(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Measures how well people and the floor are found in depth images.",
               "deixis-evaluate-people");
  app.set_version_flag("--version", "deixis-evaluate-people " DEIXIS_VERSION);
  app.add_option("--sequence", arguments.sequences,
                 "Folder with calibration, depth/ and mask/ of a rendered sequence")
      ->required();
  app.add_option("--logs", arguments.logs,
                 "Folder of logs with STEREO, named as the sequences: their depth instead of the "
                 "true one");
  app.add_option("--width", arguments.width_px, "Columns of the true depth")
      ->check(CLI::Range(16, 4096));
  app.add_option("--pictures", arguments.pictures, "Write pictures of depth and regions here");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? program::kStopped : program::kWrongCommand);
  }
  return arguments;
}

double Percent(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

nlohmann::json Figures(const std::string& name, const PeopleScore& score) {
  const auto quantile = [](const std::vector<double>& values, double share) -> nlohmann::json {
    const auto value = Quantile(values, share);
    return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
  };
  return {
      {"name", name},
      {"frames", score.frames},
      {"people", score.people},
      {"found_people", score.found_people},
      {"recall_percent", Percent(score.found_pixels, score.person_pixels)},
      {"precision_percent", Percent(score.region_pixels - score.wrong_pixels, score.region_pixels)},
      {"unsound_percent", Percent(score.unsound_pixels, score.person_pixels)},
      {"false_regions", score.false_regions},
      {"floors", score.floors},
      {"tilt_median_deg", quantile(score.tilts_deg, 0.5)},
      {"tilt_p95_deg", quantile(score.tilts_deg, 0.95)},
      {"height_median_m", quantile(score.heights_m, 0.5)},
      {"height_p95_m", quantile(score.heights_m, 0.95)},
      {"ms_median", quantile(score.times_ms, 0.5)}};
}

void WritePicture(const fs::path& folder, const std::string& name, const PeopleFrame& frame,
                  const PeopleRegions& found) {
  cv::Mat grey, colours;
  frame.depth_mm.convertTo(grey, CV_8U, -255.0 / 4500.0, 255.0 * 5300.0 / 4500.0);
  grey.setTo(0, frame.depth_mm == 0);
  cv::cvtColor(grey, colours, cv::COLOR_GRAY2BGR);
  const std::vector<cv::Vec3b> paints = {{60, 60, 255},  {60, 255, 60},  {255, 80, 60},
                                         {40, 220, 255}, {255, 60, 255}, {255, 255, 60}};
  for (int i = 0; i < static_cast<int>(colours.total()); ++i) {
    const std::uint8_t label = found.labels[static_cast<std::size_t>(i)];
    auto& pixel = colours.at<cv::Vec3b>(i);
    const bool is_person = frame.has_truth && frame.person.at<std::uint8_t>(i) != 0;
    if (label != 0) {
      const cv::Vec3b& paint = paints[(label - 1U) % paints.size()];
      pixel = cv::Vec3b(cv::Vec3d(pixel) * 0.5 + cv::Vec3d(paint) * 0.5);
    } else if (is_person) {
      pixel = cv::Vec3b(255, 255, 255);
    }
  }
  fs::create_directories(folder);
  const std::string path = (folder / (name + ".png")).string();
  if (!cv::imwrite(path, colours)) {
    throw config::ConfigError(path + ": cannot be written; give another --pictures folder");
  }
}

PeopleScore Evaluate(const fs::path& folder, const Arguments& arguments) {
  const std::string name = folder.filename().string();
  PeopleSequence sequence(folder,
                          arguments.logs.empty() ? fs::path() : arguments.logs / (name + ".lcmlog"),
                          arguments.width_px);
  DepthView view;
  SoundDepth sound;
  FloorTracker floor;
  PeopleFinder finder;
  PeopleScore score;
  while (const auto frame = sequence.Next()) {
    view.Update(frame->camera, frame->depth_mm);
    const auto start = std::chrono::steady_clock::now();
    const auto& is_sound = sound.Find(view);
    floor.Update(view, is_sound, frame->time_s);
    const PeopleRegions& found = finder.Find(view, is_sound, floor.floor());
    score.AddTime(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
            .count());
    if (!frame->has_truth) continue;
    score.AddFrame(*frame, found, is_sound);
    if (!arguments.pictures.empty() && score.frames % 10 == 5) {
      WritePicture(arguments.pictures, name + "_" + std::to_string(score.frames), *frame, found);
    }
  }
  return score;
}

void RunAll(const Arguments& arguments) {
  PeopleScore all;
  for (const fs::path& folder : arguments.sequences) {
    const PeopleScore score = Evaluate(folder, arguments);
    std::cout << Figures(folder.filename().string(), score).dump() << std::endl;
    all.Add(score);
  }
  std::cout << Figures("all", all).dump() << '\n';
  program::FinishOutput(std::cout);
}

}  // namespace
}  // namespace deixis::pose_fitter

int main(int argc, char** argv) {
  try {
    deixis::pose_fitter::RunAll(deixis::pose_fitter::Parse(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "deixis-evaluate-people: " << error.what() << "\n";
    return deixis::program::kCannotWork;
  }
  return deixis::program::kStopped;
}
