// Time per picture of the face detector against OpenCV's own way: a cascade over the whole picture,
// every picture. Both in one run on the same clip; `found` is the share of pictures in which a face
// was seen, so that the times can be compared at equal or better recall.
//   face_benchmark --benchmark_repetitions=5 --benchmark_report_aggregates_only=true
#include <benchmark/benchmark.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>
#include <opencv2/videoio.hpp>

#include "services/object_detector/core/object_detector.h"

namespace deixis::object_detector {
namespace {

constexpr std::size_t kPictures = 150;
constexpr std::int64_t kPeriod_us = 66'667;
constexpr const char* kCascade = "/usr/share/opencv4/haarcascades/haarcascade_frontalface_alt2.xml";

std::vector<cv::Mat> ReadClip(cv::Size size) {
  cv::setNumThreads(1);
  cv::VideoCapture video(DEIXIS_SOURCE_DIR "/test/data/clips/spread_01/left.mp4");
  std::vector<cv::Mat> pictures;
  cv::Mat bgr;
  while (pictures.size() < kPictures && video.read(bgr)) {
    pictures.emplace_back();
    cv::resize(bgr, pictures.back(), size, 0, 0, cv::INTER_AREA);
  }
  return pictures;
}

cv::Size SizeOf(const benchmark::State& state) {
  return {static_cast<int>(state.range(0)), static_cast<int>(state.range(1))};
}

void Report(std::int64_t found, std::size_t pictures, benchmark::State& state) {
  const auto shown = static_cast<double>(state.iterations()) * static_cast<double>(pictures);
  state.counters["found"] = static_cast<double>(found) / std::max(1.0, shown);
  state.counters["per_picture"] =
      benchmark::Counter(shown, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

bool SeesAFace(const scene::Objects& objects) {
  return std::any_of(objects.objects.begin(), objects.objects.end(), [](const auto& object) {
    return object.visibility == scene::Visibility::kSeen;
  });
}

void FaceDetector(benchmark::State& state) {
  const std::vector<cv::Mat> clip = ReadClip(SizeOf(state));
  if (clip.empty()) return state.SkipWithError("test clip not found");
  std::int64_t found = 0;
  for ([[maybe_unused]] auto _ : state) {
    ObjectDetector detector{DetectorsConfig{}};
    std::int64_t time_us = 0;
    for (const cv::Mat& bgr : clip) {
      found += SeesAFace(detector.Detect({{time_us += kPeriod_us}, "CAMERA", bgr})) ? 1 : 0;
    }
  }
  Report(found, clip.size(), state);
}

void WholePictureCascade(benchmark::State& state) {
  const std::vector<cv::Mat> clip = ReadClip(SizeOf(state));
  cv::CascadeClassifier cascade;
  if (clip.empty() || !cascade.load(kCascade))
    return state.SkipWithError("clip or cascade missing");
  const ScanConfig scan;
  std::int64_t found = 0;
  cv::Mat grey;
  std::vector<cv::Rect> faces;
  for ([[maybe_unused]] auto _ : state) {
    for (const cv::Mat& bgr : clip) {
      cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
      const int smallest = static_cast<int>(scan.min_height * grey.rows);
      const int largest = static_cast<int>(scan.max_height * grey.rows);
      cascade.detectMultiScale(grey, faces, 1.1, 3, 0, {smallest, smallest}, {largest, largest});
      found += faces.empty() ? 0 : 1;
    }
  }
  Report(found, clip.size(), state);
}

BENCHMARK(FaceDetector)->Args({640, 480})->Args({320, 240})->Unit(benchmark::kMillisecond);
BENCHMARK(WholePictureCascade)->Args({640, 480})->Args({320, 240})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace deixis::object_detector
