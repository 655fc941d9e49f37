// Depth of 640x480 brought into the colour camera's view, 25 mm beside it, with the plain ways of
// the same beside it in the same run: each depth pixel to the nearest pixel, which leaves pinholes.
// One thread.
#include <benchmark/benchmark.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "services/stereo_driver/core/calibration/camera_matrix.h"
#include "services/stereo_driver/core/depth_camera/depth_registration.h"

namespace deixis::stereo_driver {
namespace {

constexpr int kDepthWidth = 640;
constexpr int kDepthHeight = 480;

geometry::CameraCalibration Lens(double focal_px) {
  geometry::CameraCalibration lens;
  lens.width_px = kDepthWidth;
  lens.height_px = kDepthHeight;
  lens.focal_px = {focal_px, focal_px};
  lens.principal_point_px = {322.0, 238.0};
  return lens;
}

DepthView View() {
  DepthView view;
  view.lens = Lens(580.0);
  view.lens.distortion_model = geometry::DistortionModel::kPlumbBob;
  view.lens.distortion = {-0.1, 0.02, 0.0, 0.0, 0.0};
  view.colour_from_depth.rotation = Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitY());
  view.colour_from_depth.translation_m = {0.025, 0.001, 0.0};
  return view;
}

/// Argument: width of the target.
geometry::CameraCalibration Target(const benchmark::State& state) {
  const auto width = static_cast<int>(state.range(0));
  return geometry::Scaled(Lens(525.0), width, width * kDepthHeight / kDepthWidth);
}

/// A floor, a wall and a body, with noise and holes.
cv::Mat Depth() {
  cv::setNumThreads(1);
  cv::Mat depth_mm(kDepthHeight, kDepthWidth, CV_16UC1, cv::Scalar(3000));
  for (int y = 300; y < kDepthHeight; ++y) depth_mm.row(y).setTo(60 * 3000 / (y - 240));
  cv::ellipse(depth_mm, {300, 260}, {70, 190}, 0, 0, 360, cv::Scalar(1400), cv::FILLED);
  cv::RNG random(2);
  for (int i = 0; i < 400; ++i) {
    cv::circle(depth_mm, {random.uniform(0, kDepthWidth), random.uniform(0, kDepthHeight)}, 4,
               cv::Scalar(0), cv::FILLED);
  }
  cv::Mat noise(depth_mm.size(), CV_16UC1);
  random.fill(noise, cv::RNG::UNIFORM, 0, 9);
  cv::add(depth_mm, noise, depth_mm, depth_mm > 0);
  return depth_mm;
}

void RegisterDepth(benchmark::State& state) {
  const cv::Mat depth_mm = Depth();
  DepthRegistration registration(View(), Target(state));
  cv::Mat registered_mm;
  for (auto _ : state) {
    registration.Register(depth_mm, registered_mm);
    benchmark::DoNotOptimize(registered_mm.data);
  }
}
BENCHMARK(RegisterDepth)->Arg(320)->Arg(640)->Arg(1280)->Unit(benchmark::kMillisecond);

std::vector<cv::Point2d> RaysOfView() {
  const DepthView view = View();
  std::vector<cv::Point2d> pixels, rays;
  for (int y = 0; y < kDepthHeight; ++y) {
    for (int x = 0; x < kDepthWidth; ++x) pixels.emplace_back(x, y);
  }
  cv::undistortPoints(pixels, rays, CameraMatrix(view.lens), view.lens.distortion);
  return rays;
}

/// To the nearest pixel; the nearest distance wins.
void Put(double u, double v, double z_mm, cv::Mat& registered_mm) {
  if (!(z_mm > 0.0 && u > -0.5 && v > -0.5)) return;
  const auto x = static_cast<int>(u + 0.5);
  const auto y = static_cast<int>(v + 0.5);
  if (x >= registered_mm.cols || y >= registered_mm.rows) return;
  auto& pixel = registered_mm.at<std::uint16_t>(y, x);
  const auto rounded = static_cast<std::uint16_t>(z_mm + 0.5);
  if (pixel == 0 || rounded < pixel) pixel = rounded;
}

/// Eigen and doubles, rays made once.
void RegisterPointByPoint(benchmark::State& state) {
  const cv::Mat depth_mm = Depth();
  const geometry::CameraCalibration target = Target(state);
  const geometry::RigidTransform colour_from_depth = View().colour_from_depth;
  const std::vector<cv::Point2d> rays = RaysOfView();
  cv::Mat registered_mm(target.height_px, target.width_px, CV_16UC1);
  for (auto _ : state) {
    registered_mm.setTo(0);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const double z_m = 0.001 * depth_mm.at<std::uint16_t>(static_cast<int>(i));
      if (z_m == 0.0) continue;
      const Eigen::Vector3d point =
          colour_from_depth * Eigen::Vector3d(rays[i].x * z_m, rays[i].y * z_m, z_m);
      const Eigen::Vector2d pixel =
          point.hnormalized().cwiseProduct(target.focal_px) + target.principal_point_px;
      Put(pixel.x(), pixel.y(), 1000.0 * point.z(), registered_mm);
    }
    benchmark::DoNotOptimize(registered_mm.data);
  }
}
BENCHMARK(RegisterPointByPoint)->Arg(320)->Arg(640)->Arg(1280)->Unit(benchmark::kMillisecond);

/// OpenCV's projection of all points, rays made once.
void RegisterByProjectPoints(benchmark::State& state) {
  const cv::Mat depth_mm = Depth();
  const geometry::CameraCalibration target = Target(state);
  const geometry::RigidTransform colour_from_depth = View().colour_from_depth;
  const std::vector<cv::Point2d> rays = RaysOfView();
  std::vector<cv::Point3d> points(rays.size());
  std::vector<cv::Point2d> pixels;
  cv::Mat registered_mm(target.height_px, target.width_px, CV_16UC1);
  for (auto _ : state) {
    registered_mm.setTo(0);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const double z_m = 0.001 * depth_mm.at<std::uint16_t>(static_cast<int>(i));
      const Eigen::Vector3d point =
          colour_from_depth * Eigen::Vector3d(rays[i].x * z_m, rays[i].y * z_m, z_m);
      points[i] = {point.x(), point.y(), z_m > 0.0 ? point.z() : 0.0};
    }
    cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), CameraMatrix(target), cv::noArray(),
                      pixels);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      Put(pixels[i].x, pixels[i].y, 1000.0 * points[i].z, registered_mm);
    }
    benchmark::DoNotOptimize(registered_mm.data);
  }
}
BENCHMARK(RegisterByProjectPoints)->Arg(320)->Arg(640)->Arg(1280)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace deixis::stereo_driver
