// Skin classification, regions and the whole tracker, with OpenCV's way of the same beside each in
// the same run. Argument: width of a 4:3 picture. Paths of hands, with the plain recursion over
// pairs of guesses beside them. Argument: candidates per image.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "common/skin/skin_model.h"
#include "services/hand_tracker/core/hand_paths.h"
#include "services/hand_tracker/core/hand_tracker.h"
#include "services/hand_tracker/core/skin_regions.h"
#include "test/services/hand_tracker/core/synthetic_person.h"

namespace deixis::hand_tracker {
namespace {

cv::Size SizeOf(const benchmark::State& state) {
  cv::setNumThreads(1);
  const int width = static_cast<int>(state.range(0));
  return {width, width * 3 / 4};
}

cv::Mat PictureOf(const benchmark::State& state) {
  return SyntheticPerson(SizeOf(state)).Picture(20).bgr;
}

/// Three clean regions: a face and two hands.
cv::Mat MaskOf(const benchmark::State& state) {
  cv::Mat mask = cv::Mat::zeros(SizeOf(state), CV_8UC1);
  const int unit = mask.cols / 12;
  const cv::Scalar white(255);
  cv::ellipse(mask, {6 * unit, 3 * unit}, {unit, unit * 3 / 2}, 0, 0, 360, white, cv::FILLED);
  cv::ellipse(mask, {3 * unit, 6 * unit}, {unit / 2, unit}, 0, 0, 360, white, cv::FILLED);
  cv::ellipse(mask, {9 * unit, 6 * unit}, {unit / 2, unit}, 0, 0, 360, white, cv::FILLED);
  return mask;
}

void ClassifyByTable(benchmark::State& state) {
  const cv::Mat picture = PictureOf(state);
  const skin::SkinModel model;
  for (auto _ : state) benchmark::DoNotOptimize(skin::Classify(picture, model.table()).data);
}
BENCHMARK(ClassifyByTable)->Arg(320)->Arg(640);

void ClassifyByCalcBackProject(benchmark::State& state) {
  const cv::Mat picture = PictureOf(state);
  const int sizes[] = {32, 32, 32};
  cv::Mat histogram(3, sizes, CV_32F);
  cv::randu(histogram, 0, 255);
  const int channels[] = {0, 1, 2};
  const float range[] = {0, 256};
  const float* ranges[] = {range, range, range};
  cv::Mat probability;
  for (auto _ : state) {
    cv::calcBackProject(&picture, 1, channels, histogram, probability, ranges);
    benchmark::DoNotOptimize(probability.data);
  }
}
BENCHMARK(ClassifyByCalcBackProject)->Arg(320)->Arg(640);

void ClassifyByHsvRange(benchmark::State& state) {
  const cv::Mat picture = PictureOf(state);
  cv::Mat hsv, mask;
  for (auto _ : state) {
    cv::cvtColor(picture, hsv, cv::COLOR_BGR2HSV);
    cv::inRange(hsv, cv::Scalar(0, 40, 60), cv::Scalar(20, 180, 255), mask);
    benchmark::DoNotOptimize(mask.data);
  }
}
BENCHMARK(ClassifyByHsvRange)->Arg(320)->Arg(640);

void RegionsByRuns(benchmark::State& state) {
  const cv::Mat mask = MaskOf(state);
  for (auto _ : state) benchmark::DoNotOptimize(FindRegions(mask, {150, 200}, 10).size());
}
BENCHMARK(RegionsByRuns)->Arg(320)->Arg(640);

void RegionsByConnectedComponents(benchmark::State& state) {
  const cv::Mat mask = MaskOf(state);
  cv::Mat labels, stats, centres;
  for (auto _ : state) {
    benchmark::DoNotOptimize(cv::connectedComponentsWithStats(mask, labels, stats, centres, 8));
  }
}
BENCHMARK(RegionsByConnectedComponents)->Arg(320)->Arg(640);

void LearnFace(benchmark::State& state) {
  const SyntheticPerson person(SizeOf(state));
  const cv::Mat picture = person.Picture(20).bgr;
  const scene::Box face = *person.Faces(20).objects[0].box;
  skin::SkinModel model;
  for (auto _ : state) benchmark::DoNotOptimize(model.LearnFromFace(picture, face, 0.1));
}
BENCHMARK(LearnFace)->Arg(320);

void TrackFrame(benchmark::State& state) {
  const SyntheticPerson person(SizeOf(state));
  std::vector<images::Image> pictures;
  for (int frame = 0; frame < 64; ++frame) pictures.push_back(person.Picture(frame));
  HandTracker tracker;
  int frame = 0;
  for (auto _ : state) {
    // To and fro, so that the motion has no jump.
    const int phase = frame % 126;
    images::Image& picture = pictures[static_cast<std::size_t>(phase < 64 ? phase : 126 - phase)];
    picture.time = SyntheticPerson::Time(frame);
    scene::Objects faces = person.Faces(phase < 64 ? phase : 126 - phase);
    faces.time = picture.time;
    tracker.UpdateFaces(faces);
    benchmark::DoNotOptimize(tracker.Track(picture).hands.size());
    ++frame;
  }
}
BENCHMARK(TrackFrame)->Arg(320)->Arg(640)->Arg(1280)->Unit(benchmark::kMillisecond);

/// Two hands that sway and other things that do not.
std::vector<HandCandidate> CandidatesOf(const benchmark::State& state) {
  std::vector<HandCandidate> candidates;
  for (int i = 0; i < state.range(0); ++i) {
    HandCandidate& candidate = candidates.emplace_back();
    candidate.centre = {100.0 + 37.0 * i, 200.0 + 11.0 * (i % 5)};
    candidate.box = {candidate.centre.x() - 10.0, candidate.centre.y() - 10.0, 20.0, 20.0};
    candidate.hand_length_px = 40.0;
    candidate.area_px = 400.0;
    candidate.region_length_px = 40.0;
    candidate.moving_share = i < 2 ? 1.0 : 0.1;
  }
  return candidates;
}

void PathsByHalfSteps(benchmark::State& state) {
  const std::vector<HandCandidate> candidates = CandidatesOf(state);
  HandPaths paths{HandPathsConfig{}};
  for (auto _ : state) {
    paths.Update(candidates, nullptr, 1.0 / 15.0);
    benchmark::DoNotOptimize(paths.hands().data());
  }
}
BENCHMARK(PathsByHalfSteps)->Arg(4)->Arg(8)->Arg(16);

/// Only the recursion, over as many guesses: every pair from every pair.
void PathsByPairSteps(benchmark::State& state) {
  const auto n = 2 * static_cast<std::size_t>(state.range(0)) + 7;
  const std::vector<double> steps(n * n, -1.0);
  std::vector<double> scores(n * n, 0.0);
  std::vector<double> next(n * n);
  for (auto _ : state) {
    for (std::size_t to = 0; to < n * n; ++to) {
      double best = -1e9;
      for (std::size_t from = 0; from < n * n; ++from) {
        const double step = steps[from / n * n + to / n] + steps[from % n * n + to % n];
        best = std::max(best, scores[from] + step);
      }
      next[to] = best;
    }
    benchmark::DoNotOptimize(next.data());
  }
}
BENCHMARK(PathsByPairSteps)->Arg(4)->Arg(8)->Arg(16);

}  // namespace
}  // namespace deixis::hand_tracker
