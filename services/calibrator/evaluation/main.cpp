// Calibrates a stereo pair from the same pictures in several ways, and measures each way alike, on
// the pairs that it was fitted to and on pairs that it was not. Writes CSV.
#include <CLI/CLI.hpp>
#include <iostream>
#include <opencv2/imgproc.hpp>

#include "common/capture/quiet_opencv.h"
#include "common/program/command_line.h"
#include "services/calibrator/core/calibration.h"
#include "services/calibrator/core/figures.h"
#include "services/calibrator/evaluation/opencv_sample.h"
#include "services/calibrator/feeds/file_feed.h"

namespace deixis::calibrator {
namespace {

struct Options {
  std::vector<std::string> left;
  std::vector<std::string> right;
  std::vector<int> count{9, 6};
  double square_m = 0.025;
};

/// One pair of pictures with both procedures' corners.
struct Scene {
  std::string name;
  Shot ours;
  CornerPair our_corners;
  CornerPair sample_corners;
  cv::Size size;
};

enum class Procedure { kSample, kJoint, kFixedLenses };

const char* NameOf(Procedure procedure) {
  switch (procedure) {
    case Procedure::kSample:
      return "opencv sample";
    case Procedure::kJoint:
      return "deixis";
    case Procedure::kFixedLenses:
      return "deixis --fixed-lenses";
  }
  return "";
}

cv::Mat Grey(const cv::Mat& bgr) {
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

std::optional<Scene> SceneOf(const Sight& sight, const Board& board) {
  if (sight.bgr[0].empty() || sight.bgr[1].empty()) return std::nullopt;
  const cv::Mat left = Grey(sight.bgr[0]);
  const cv::Mat right = Grey(sight.bgr[1]);
  const auto views = std::make_pair(Look(left, board), Look(right, board));
  const auto sample = std::make_pair(SampleCorners(left, board.layout.corners),
                                     SampleCorners(right, board.layout.corners));
  if (!views.first || !views.second || !sample.first || !sample.second) return std::nullopt;
  return Scene{sight.name,
               {sight.name, sight.time, {*views.first, *views.second}},
               PairOf(views.first->corners, views.second->corners, board.layout),
               PairOf(*sample.first, *sample.second, board.layout),
               left.size()};
}

std::vector<Scene> ReadScenes(const Options& options, const Board& board) {
  FileFeed feed({FilesOf(options.left, "--left"), FilesOf(options.right, "--right")});
  std::vector<Scene> scenes;
  for (Take take = feed.Next(); take.sight; take = feed.Next()) {
    auto scene = SceneOf(*take.sight, board);
    if (scene) {
      scenes.push_back(std::move(*scene));
    } else {
      std::cerr << "deixis-evaluate-calibration: not used: " << take.sight->name
                << " (the board is not found by both ways in both pictures)\n";
    }
  }
  return scenes;
}

std::vector<CornerPair> CornersOf(const std::vector<Scene>& scenes, Procedure whose) {
  std::vector<CornerPair> pairs;
  for (const Scene& scene : scenes) {
    pairs.push_back(whose == Procedure::kSample ? scene.sample_corners : scene.our_corners);
  }
  return pairs;
}

StereoFit Fit(const std::vector<Scene>& scenes, Procedure procedure, const BoardLayout& layout) {
  if (procedure == Procedure::kSample) {
    return SampleFit(CornersOf(scenes, procedure), layout, scenes.front().size);
  }
  std::vector<Shot> shots;
  for (const Scene& scene : scenes) shots.push_back(scene.ours);
  CalibrationOptions options;
  options.refinement =
      procedure == Procedure::kJoint ? Refinement::kJoint : Refinement::kPlacesOnly;
  return CalibrateStereo(shots, layout, options).fit;
}

std::vector<double> Rows(const StereoFit& fit, const std::vector<CornerPair>& pairs) {
  std::vector<double> rows;
  for (const CornerPair& pair : pairs) {
    const auto of_pair = RowDifferences_px(fit, pair);
    rows.insert(rows.end(), of_pair.begin(), of_pair.end());
  }
  return rows;
}

/// One camera's corners of all pairs: `whose` is &CornerPair::first (left) or second (right).
std::vector<Corners> CornersOf(const std::vector<CornerPair>& pairs, Corners CornerPair::*whose) {
  std::vector<Corners> views;
  for (const CornerPair& pair : pairs) views.push_back(pair.*whose);
  return views;
}

/// Root mean square error of one camera over all views, each with the pose that suits it best.
double LensError_px(const Lens& lens, const std::vector<Corners>& views,
                    const BoardLayout& layout) {
  double sum = 0.0;
  for (const Corners& view : views) {
    const double error_px = ReprojectionError_px(lens, layout, view).value_or(1e3);
    sum += error_px * error_px / static_cast<double>(views.size());
  }
  return std::sqrt(sum);
}

/// Row differences of pairs that had no part in the fit: odd ones by the even ones' fit, and the
/// other way round.
std::vector<double> HeldOutRows(const std::vector<Scene>& scenes, Procedure procedure,
                                Procedure corners, const BoardLayout& layout) {
  std::vector<Scene> halves[2];
  for (std::size_t i = 0; i < scenes.size(); ++i) halves[i % 2].push_back(scenes[i]);
  std::vector<double> rows;
  for (std::size_t half = 0; half < 2; ++half) {
    const StereoFit fit = Fit(halves[half], procedure, layout);
    const auto of_half = Rows(fit, CornersOf(halves[1 - half], corners));
    rows.insert(rows.end(), of_half.begin(), of_half.end());
  }
  return rows;
}

void Print(const char* part, const char* procedure, const ErrorSummary& rows) {
  std::cout << Figures("%s,%s,rows,%.4f,%.4f,%.4f\n", procedure, part, rows.mean, rows.median,
                       rows.p95);
}

void Evaluate(const std::vector<Scene>& scenes, Procedure procedure, const BoardLayout& layout) {
  const StereoFit fit = Fit(scenes, procedure, layout);
  const auto pairs = CornersOf(scenes, procedure);
  const char* name = NameOf(procedure);
  std::cout << Figures("%s,all,fit,%.4f,%.4f,%.4f\n", name,
                       LensError_px(fit.left, CornersOf(pairs, &CornerPair::first), layout),
                       LensError_px(fit.right, CornersOf(pairs, &CornerPair::second), layout),
                       fit.error_px);
  std::cout << Figures("%s,all,place,%.6f,%.4f,%.2f\n", name, cv::norm(fit.translation_m),
                       SampleEpipolarError_px(fit, pairs), fit.left.matrix(0, 0));
  Print("fitted", name, Summarise(Rows(fit, pairs)));
  Print("held out", name, Summarise(HeldOutRows(scenes, procedure, procedure, layout)));
  Print("held out at the sample's corners", name,
        Summarise(HeldOutRows(scenes, procedure, Procedure::kSample, layout)));
}

void Run(const Options& options) {
  capture::KeepOpenCvQuiet();
  BoardConfig config;
  config.count = {options.count[0], options.count[1]};
  config.square_m = options.square_m;
  const Board board = MakeBoard(config);
  const auto scenes = ReadScenes(options, board);
  constexpr std::size_t kFewest = 8;
  if (scenes.size() < kFewest) {
    throw std::runtime_error(std::to_string(scenes.size()) +
                             " pairs show the board, 8 are the least: check --board and --data");
  }
  std::cout << "procedure,part,what,a,b,c\n"
            << "all,all,pairs," << scenes.size() << ",0,0\n";
  for (const Procedure procedure :
       {Procedure::kSample, Procedure::kJoint, Procedure::kFixedLenses}) {
    Evaluate(scenes, procedure, board.layout);
  }
}

}  // namespace
}  // namespace deixis::calibrator

int main(int argc, char** argv) {
  using namespace deixis;
  calibrator::Options options;
  CLI::App app("Measures ways to calibrate a stereo pair on the same pictures.",
               "deixis-evaluate-calibration");
  app.set_version_flag("--version", "deixis-evaluate-calibration " DEIXIS_VERSION);
  app.add_option("--left", options.left, "The left camera's pictures")->required();
  app.add_option("--right", options.right, "The right camera's")->required();
  app.add_option("--board", options.count, "Inner corners: columns rows")->expected(2);
  app.add_option("--square", options.square_m, "Side of a square, metres");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? program::kStopped : program::kWrongCommand;
  }
  try {
    calibrator::Run(options);
  } catch (const std::exception& error) {
    std::cerr << "deixis-evaluate-calibration: " << error.what() << "\n";
    return program::kCannotWork;
  }
  return program::kStopped;
}
