// Rectification, matching, refinement and depth at 640x480, with OpenCV's way of the same beside
// each in the same run. One thread.
#include <benchmark/benchmark.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "services/stereo_driver/core/calibration/camera_matrix.h"
#include "services/stereo_driver/core/matching/stereo_matcher.h"

namespace deixis::stereo_driver {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr int kSearched = 112;
constexpr int kShift_px = 30;

geometry::StereoCalibration Rig() {
  geometry::StereoCalibration rig;
  rig.rectified.width_px = kWidth;
  rig.rectified.height_px = kHeight;
  rig.rectified.focal_px = {550.0, 550.0};
  rig.rectified.principal_point_px = {319.5, 239.5};
  rig.left = rig.right = rig.rectified;
  rig.left.distortion = rig.right.distortion = {-0.1, 0.02, 0.0, 0.0, 0.0};
  rig.right_from_left.translation_m.x() = -0.12;
  return rig;
}

/// A textured wall, `kShift_px` to the left in the right picture.
images::StereoPair Pair() {
  cv::setNumThreads(1);
  cv::RNG random(1);
  cv::Mat wall(kHeight, kWidth + kShift_px, CV_8UC3);
  random.fill(wall, cv::RNG::UNIFORM, 0, 255);
  cv::GaussianBlur(wall, wall, {0, 0}, 1.5);
  images::StereoPair pair;
  pair.left.bgr = wall.colRange(0, kWidth).clone();
  pair.right.bgr = wall.colRange(kShift_px, kShift_px + kWidth).clone();
  return pair;
}

struct GreyPair {
  cv::Mat left, right;
  GreyPair() {
    const images::StereoPair pair = Pair();
    cv::cvtColor(pair.left.bgr, left, cv::COLOR_BGR2GRAY);
    cv::cvtColor(pair.right.bgr, right, cv::COLOR_BGR2GRAY);
  }
};

void RectifyPair(benchmark::State& state) {
  const images::StereoPair pair = Pair();
  Rectifier rectifier(Rig());
  RectifiedPair rectified;
  for (auto _ : state) {
    rectifier.Rectify(pair, rectified);
    benchmark::DoNotOptimize(rectified.left_grey.data);
  }
}
BENCHMARK(RectifyPair)->Unit(benchmark::kMillisecond);

/// The same with maps of floats, as undistort-and-rectify is often written.
void RectifyPairByFloatMaps(benchmark::State& state) {
  const images::StereoPair pair = Pair();
  const geometry::StereoCalibration rig = Rig();
  cv::Mat columns, rows, left, right, left_grey, right_grey;
  cv::initUndistortRectifyMap(CameraMatrix(rig.left), rig.left.distortion, cv::noArray(),
                              CameraMatrix(rig.rectified), {kWidth, kHeight}, CV_32FC1, columns,
                              rows);
  for (auto _ : state) {
    cv::remap(pair.left.bgr, left, columns, rows, cv::INTER_LINEAR);
    cv::remap(pair.right.bgr, right, columns, rows, cv::INTER_LINEAR);
    cv::cvtColor(left, left_grey, cv::COLOR_BGR2GRAY);
    cv::cvtColor(right, right_grey, cv::COLOR_BGR2GRAY);
    benchmark::DoNotOptimize(left_grey.data);
  }
}
BENCHMARK(RectifyPairByFloatMaps)->Unit(benchmark::kMillisecond);

DisparityConfig ConfigOf(const benchmark::State& state) {
  DisparityConfig config;
  config.method = static_cast<Method>(state.range(0));
  return config;
}

/// Argument: 0 = sgbm_3way, 1 = bm. Matches the left border too.
void Match(benchmark::State& state) {
  const GreyPair pair;
  DisparityMatcher matcher(ConfigOf(state), kSearched);
  cv::Mat disparity;
  for (auto _ : state) {
    matcher.Match(pair.left, pair.right, disparity);
    benchmark::DoNotOptimize(disparity.data);
  }
}
BENCHMARK(Match)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// Leaves the left border out.
void MatchByOpenCvAlone(benchmark::State& state) {
  const GreyPair pair;
  const auto matcher = MakeMatcher(ConfigOf(state), kSearched);
  cv::Mat disparity;
  for (auto _ : state) {
    matcher->compute(pair.left, pair.right, disparity);
    benchmark::DoNotOptimize(disparity.data);
  }
}
BENCHMARK(MatchByOpenCvAlone)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void Refine(benchmark::State& state) {
  const GreyPair pair;
  cv::Mat matched, disparity;
  DisparityMatcher({}, kSearched).Match(pair.left, pair.right, matched);
  DisparityRefiner refiner({});
  for (auto _ : state) {
    matched.copyTo(disparity);
    refiner.Refine(pair.left, pair.right, disparity);
    benchmark::DoNotOptimize(disparity.data);
  }
}
BENCHMARK(Refine)->Unit(benchmark::kMillisecond);

/// A person's size before the wall, 50 px to the left in the right picture.
const cv::Rect kSomebody = {240, 60, 130, 400};

images::StereoPair PairWithSomebody() {
  images::StereoPair pair = Pair();
  cv::Mat somebody(kSomebody.size(), CV_8UC3);
  cv::RNG random(2);
  random.fill(somebody, cv::RNG::UNIFORM, 0, 255);
  cv::GaussianBlur(somebody, somebody, {0, 0}, 1.5);
  somebody.copyTo(pair.left.bgr(kSomebody));
  somebody.copyTo(pair.right.bgr(kSomebody - cv::Point(50, 0)));
  return pair;
}

geometry::StereoCalibration RigWithoutDistortion() {
  geometry::StereoCalibration rig = Rig();
  rig.left.distortion = rig.right.distortion = {};
  rig.left.distortion_model = rig.right.distortion_model = geometry::DistortionModel::kNone;
  return rig;
}

/// From pair to depth. Arguments: match_size; 1 = said where somebody is, with 40 px around.
void Measure(benchmark::State& state) {
  const images::StereoPair pair = PairWithSomebody();
  StereoMatcherConfig config;
  config.match_size = static_cast<MatchSize>(state.range(0));
  StereoMatcher matcher(config, RigWithoutDistortion());
  const cv::Rect around = kSomebody - cv::Point(40, 40) + cv::Size(80, 80);
  const Windows said = state.range(1) != 0 ? Windows{around} : Windows{};
  for (auto _ : state) benchmark::DoNotOptimize(matcher.Measure(pair, said).depth_mm.data);
}
BENCHMARK(Measure)
    ->ArgNames({"match_size", "said"})
    ->Args({static_cast<int>(MatchSize::kHalf), 0})
    ->Args({static_cast<int>(MatchSize::kPeople), 0})
    ->Args({static_cast<int>(MatchSize::kPeople), 1})
    ->Args({static_cast<int>(MatchSize::kFull), 0})
    ->Unit(benchmark::kMillisecond);

/// Rectification and cv::StereoSGBM, MODE_SGBM_3WAY, 96 disparities over the full picture.
void MeasureByFullSgbm(benchmark::State& state) {
  const images::StereoPair pair = PairWithSomebody();
  Rectifier rectifier(RigWithoutDistortion());
  const auto matcher = MakeMatcher({}, 96);
  RectifiedPair rectified;
  cv::Mat disparity;
  for (auto _ : state) {
    rectifier.Rectify(pair, rectified);
    matcher->compute(rectified.left_grey, rectified.right_grey, disparity);
    benchmark::DoNotOptimize(disparity.data);
  }
}
BENCHMARK(MeasureByFullSgbm)->Unit(benchmark::kMillisecond);

/// Disparities of all sizes, with holes.
cv::Mat Disparities() {
  cv::setNumThreads(1);
  cv::Mat disparity(kHeight, kWidth, CV_16SC1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int value = 120 + (x * 3 + y * 2) % 1500;
      disparity.at<std::int16_t>(y, x) =
          static_cast<std::int16_t>((x / 9 + y / 7) % 11 == 0 ? kNoDisparity : value);
    }
  }
  return disparity;
}

const DepthGeometry kGeometry = {550.0, 0.12, 0.6, 10.0};

void DepthFull(benchmark::State& state) {
  const cv::Mat disparity = Disparities();
  const DepthConverter converter(kGeometry, kSearched);
  cv::Mat depth_mm;
  for (auto _ : state) {
    converter.Convert(disparity, depth_mm);
    benchmark::DoNotOptimize(depth_mm.data);
  }
}
BENCHMARK(DepthFull)->Unit(benchmark::kMicrosecond);

void DepthHalved(benchmark::State& state) {
  const cv::Mat disparity = Disparities();
  const DepthConverter converter(kGeometry, kSearched);
  cv::Mat depth_mm;
  for (auto _ : state) {
    converter.ConvertHalved(disparity, depth_mm);
    benchmark::DoNotOptimize(depth_mm.data);
  }
}
BENCHMARK(DepthHalved)->Unit(benchmark::kMicrosecond);

/// Points, of which the third coordinate is the depth.
void DepthByReprojectImageTo3D(benchmark::State& state) {
  const cv::Mat disparity = Disparities();
  const cv::Mat reprojection =
      (cv::Mat_<double>(4, 4) << 1, 0, 0, -319.5, 0, 1, 0, -239.5, 0, 0, 0, 550, 0, 0, 1 / 0.12, 0);
  cv::Mat disparity_px, points, depth_m, depth_mm;
  for (auto _ : state) {
    disparity.convertTo(disparity_px, CV_32F, 1.0 / kDisparityScale);
    cv::reprojectImageTo3D(disparity_px, points, reprojection);
    cv::extractChannel(points, depth_m, 2);
    depth_m.convertTo(depth_mm, CV_16U, 1000.0);
    benchmark::DoNotOptimize(depth_mm.data);
  }
}
BENCHMARK(DepthByReprojectImageTo3D)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace deixis::stereo_driver
