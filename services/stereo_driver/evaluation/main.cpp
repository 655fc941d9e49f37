// Runs stereo over sequences whose depth is known, and over pairs whose disparity is, OpenCV's own
// way beside it in the same run, and prints the figures as CSV.
#include <CLI/CLI.hpp>
#include <ctime>
#include <iostream>
#include <opencv2/core.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "common/program/command_line.h"
#include "services/stereo_driver/core/calibration/rig_calibration.h"
#include "services/stereo_driver/core/matching/stereo_matcher.h"
#include "services/stereo_driver/evaluation/disparity_pair.h"
#include "services/stereo_driver/evaluation/error_picture.h"
#include "services/stereo_driver/evaluation/plain_opencv.h"
#include "services/stereo_driver/evaluation/rendered_truth.h"
#include "services/stereo_driver/stereo_driver_service.h"

namespace deixis::stereo_driver {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::vector<fs::path> sequences;
  std::vector<std::string> pairs;
  std::string config_file;
  std::vector<std::string> overrides;
  fs::path pictures;
  int every = 1;
  int threads = 1;
};

Arguments Parse(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Measures the depth of the stereo driver, and OpenCV's beside it.",
               "deixis-evaluate-depth");
  app.set_version_flag("--version", "deixis-evaluate-depth " DEIXIS_VERSION);
  app.add_option("--sequence", arguments.sequences, "Folder with videos, calibration and truth");
  app.add_option("--pair", arguments.pairs,
                 "Rectified pair: name,left,right,truth,truth's values per pixel")
      ->check(PairFault);
  app.add_option("--config", arguments.config_file, "Configuration of the stereo driver")
      ->check(program::EmptyFault);
  app.add_option("--set", arguments.overrides, "Override a key: key=value")
      ->check(program::AssignmentFault);
  app.add_option("--pictures", arguments.pictures, "Write pictures of depth and error here");
  app.add_option("--every", arguments.every, "Use every n-th frame that has a truth")
      ->check(CLI::PositiveNumber);
  app.add_option("--threads", arguments.threads, "Threads of OpenCV")->check(CLI::PositiveNumber);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? program::kStopped : program::kWrongCommand);
  }
  return arguments;
}

/// Of this thread where it works alone, so that what else runs on the machine does not count.
double Now_ms() {
  timespec now{};
  clock_gettime(cv::getNumThreads() > 1 ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

template <typename Work>
double Milliseconds(const Work& work) {
  const double start_ms = Now_ms();
  work();
  return Now_ms() - start_ms;
}

/// What was measured, with all ways.
struct Scores {
  DepthScore ours;    ///< As configured.
  DepthScore people;  ///< With MatchSize::kPeople, nobody saying where they are.
  DepthScore said;    ///< The same, the true bodies being said.
  DepthScore plain;
  void Add(const Scores& other) {
    ours.Add(other.ours);
    people.Add(other.people);
    said.Add(other.said);
    plain.Add(other.plain);
  }
  void Print(const std::string& name) const {
    std::cout << CsvLine(name, "deixis", ours) << '\n';
    if (!people.times_ms.empty()) {
      std::cout << CsvLine(name, "people", people) << '\n' << CsvLine(name, "said", said) << '\n';
    }
    std::cout << CsvLine(name, "opencv", plain) << '\n';
    std::cout.flush();
  }
};

/// Depth published at half size, aligned at full size where people can be.
class PeopleWay {
 public:
  PeopleWay(StereoMatcherConfig config, const geometry::StereoCalibration& calibration)
      : matcher_(ForPeople(config), calibration), truth_(calibration) {}

  void Measure(const TrueFrame& frame, const Windows& said, DepthScore& score) {
    score.AddTime(Milliseconds([&] { matcher_.Measure(frame.pair, said); }));
    truth_.Compare(frame, matcher_.result().depth_mm, 0.001, score);
  }

 private:
  static StereoMatcherConfig ForPeople(StereoMatcherConfig config) {
    config.match_size = MatchSize::kPeople;
    return config;
  }
  StereoMatcher matcher_;
  RenderedTruth truth_;
};

/// As a tracker would say them: around all bodies, with a margin.
Windows WindowsOf(const TrueFrame& frame) {
  constexpr int kMargin_px = 40;
  const cv::Rect bodies = cv::boundingRect(frame.is_body);
  if (bodies.empty()) return {};
  return {bodies + cv::Size(2 * kMargin_px, 2 * kMargin_px) - cv::Point(kMargin_px, kMargin_px)};
}

geometry::StereoCalibration CalibrationOf(const fs::path& folder, RigCalibrationConfig config,
                                          cv::Size size) {
  config.intrinsics = (folder / "intrinsics.yml").string();
  config.extrinsics = (folder / "extrinsics.yml").string();
  return RigCalibration(config).For(size).calibration;
}

Scores Evaluate(const fs::path& folder, const StereoDriverServiceConfig& config,
                const Arguments& arguments) {
  RenderedSequence sequence(folder, arguments.every);
  auto frame = sequence.Next();
  const auto calibration =
      CalibrationOf(folder, config.driver.calibration, frame->pair.left.bgr.size());
  StereoMatcher matcher(config.driver.matcher, calibration);
  const int full_disparities =
      matcher.num_disparities() * (config.driver.matcher.match_size == MatchSize::kFull ? 1 : 2);
  PeopleWay people(config.driver.matcher, calibration);
  PlainOpenCv plain(calibration, config.driver.matcher.disparity.method, full_disparities);
  const RenderedTruth truth(calibration);
  const RenderedTruth plain_truth(plain.calibration());
  Scores scores;
  for (std::size_t i = 0; frame; frame = sequence.Next(), ++i) {
    const images::StereoPair& pair = frame->pair;
    scores.ours.AddTime(Milliseconds([&] { matcher.Measure(pair); }));
    scores.plain.AddTime(Milliseconds([&] { plain.Measure(pair); }));
    people.Measure(*frame, {}, scores.people);
    people.Measure(*frame, WindowsOf(*frame), scores.said);
    const RectifiedDepth& result = matcher.result();
    const cv::Mat errors_m = truth.Compare(*frame, result.depth_mm, 0.001, scores.ours);
    plain_truth.Compare(*frame, plain.depth_m(), 1.0, scores.plain);
    if (!arguments.pictures.empty() && i == sequence.frame_count() / 2) {
      WriteErrorPicture(arguments.pictures, folder.filename().string(), result, errors_m);
    }
  }
  return scores;
}

Scores Evaluate(const DisparityPair& pair, const StereoMatcherConfig& config) {
  const int num_disparities = SearchedDisparities({}, pair.largest_px, pair.left_bgr.cols);
  DisparityMatcher matcher(config.disparity, num_disparities);
  DisparityRefiner refiner(config.refinement);
  const auto plain = PlainMatcher(config.disparity.method, num_disparities);
  cv::Mat disparity, plain_disparity;
  Scores scores;
  scores.ours.AddTime(Milliseconds([&] {
    matcher.Match(pair.left_grey, pair.right_grey, disparity);
    refiner.Refine(pair.left_grey, pair.right_grey, disparity);
  }));
  const bool is_bm = config.disparity.method == Method::kBm;
  scores.plain.AddTime(Milliseconds([&] {
    plain->compute(is_bm ? pair.left_grey : pair.left_bgr, is_bm ? pair.right_grey : pair.right_bgr,
                   plain_disparity);
  }));
  Compare(pair, disparity, plain_disparity, scores.ours);
  Compare(pair, plain_disparity, disparity, scores.plain);
  return scores;
}

void RunAll(const Arguments& arguments) {
  cv::setNumThreads(arguments.threads);
  const std::string file =
      arguments.config_file.empty() ? "stereo_driver.yaml" : arguments.config_file;
  const auto config =
      config::Load<StereoDriverServiceConfig>(config::FindConfig(file), arguments.overrides);
  if (arguments.sequences.empty() && arguments.pairs.empty()) {
    throw config::ConfigError("nothing to measure; give --sequence or --pair");
  }
  std::cout << CsvHeading() << std::endl;
  Scores all;
  for (const fs::path& folder : arguments.sequences) {
    const Scores scores = Evaluate(folder, config, arguments);
    scores.Print(folder.filename().string());
    all.Add(scores);
  }
  if (!arguments.sequences.empty()) all.Print("all");
  for (const std::string& text : arguments.pairs) {
    const DisparityPair pair = ReadPair(text);
    Evaluate(pair, config.driver.matcher).Print(pair.name);
  }
}

}  // namespace
}  // namespace deixis::stereo_driver

int main(int argc, char** argv) {
  try {
    deixis::stereo_driver::RunAll(deixis::stereo_driver::Parse(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "deixis-evaluate-depth: " << error.what() << "\n";
    return deixis::program::kCannotWork;
  }
  return deixis::program::kStopped;
}
