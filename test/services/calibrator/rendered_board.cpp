#include "test/services/calibrator/rendered_board.h"

#include <cmath>
#include <numeric>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "services/calibrator/core/board_print.h"

namespace deixis::calibrator::test {
namespace {

constexpr double kPaperPxPerMetre = 4000.0;
constexpr double kGrey = 110.0;

cv::Matx33d MatrixOf(const cv::Vec3d& rotation) {
  cv::Matx33d matrix;
  cv::Rodrigues(rotation, matrix);
  return matrix;
}

}  // namespace

Lens WideLens() {
  return {LensModel::kPlumbBob,
          {640, 480},
          cv::Matx33d(460.0, 0, 325.0, 0, 458.0, 236.0, 0, 0, 1),
          {-0.28, 0.09, 0.0006, -0.0004, -0.012}};
}

std::vector<BoardPose> Poses(cv::Size2d size, double distance_m, int count) {
  const std::vector<cv::Point2d> places{{0, 0},     {-1, -1},  {1, 1},      {1, -1},  {-1, 1},
                                        {0.5, 0.3}, {-0.6, 0}, {0.2, -0.8}, {0, 0.9}, {0.9, 0}};
  const std::vector<cv::Vec2d> tilts{{0.1, 0},  {0.5, 0.1}, {-0.5, 0.1},  {0.1, 0.5},
                                     {0, -0.5}, {0.4, 0.4}, {-0.4, -0.3}, {0.3, -0.5}};
  std::vector<BoardPose> poses;
  for (int i = 0; i < count; ++i) {
    const auto number = static_cast<std::size_t>(i);
    const cv::Vec2d tilt = tilts[number % tilts.size()];
    const cv::Point2d place = places[number % places.size()];
    const double z_m = distance_m * (1.0 + 0.12 * (i % 4));
    const cv::Vec3d rotation(tilt[0], tilt[1], 0.12 * (i % 3 - 1));
    const cv::Vec3d centre(0.30 * place.x * z_m, 0.20 * place.y * z_m, z_m);
    const cv::Vec3d middle(0.5 * size.width, 0.5 * size.height, 0);
    poses.push_back({rotation, centre - MatrixOf(rotation) * middle});
  }
  return poses;
}

BoardPose SeenFromRight(const BoardPose& pose, double baseline_m, const cv::Vec3d& turn) {
  const cv::Matx33d right_from_left = MatrixOf(turn);
  BoardPose seen;
  cv::Rodrigues(right_from_left * MatrixOf(pose.rotation), seen.rotation);
  seen.translation_m = right_from_left * (pose.translation_m - cv::Vec3d(baseline_m, 0, 0));
  return seen;
}

BoardCamera::BoardCamera(const Lens& lens, const BoardLayout& layout)
    : lens_(lens), layout_(layout), paper_(DrawBoard(layout, kPaperPxPerMetre)) {
  for (const cv::Point2f place : {cv::Point2f(-0.25F, -0.25F), cv::Point2f(0.25F, -0.25F),
                                  cv::Point2f(-0.25F, 0.25F), cv::Point2f(0.25F, 0.25F)}) {
    std::vector<cv::Point2f> pixels;
    for (int v = 0; v < lens.size.height; ++v) {
      for (int u = 0; u < lens.size.width; ++u) {
        pixels.emplace_back(static_cast<float>(u) + place.x, static_cast<float>(v) + place.y);
      }
    }
    const auto rays = Undistort(lens, pixels, cv::Matx33d::eye(), cv::Matx34d::eye());
    rays_.push_back(cv::Mat(rays, true).reshape(2, lens.size.height));
  }
}

cv::Mat BoardCamera::TakeOnce(const BoardPose& pose, const cv::Mat& rays) const {
  const cv::Matx33d rotation = MatrixOf(pose.rotation);
  const cv::Vec3d& t = pose.translation_m;
  const cv::Matx33d ray_from_board(rotation(0, 0), rotation(0, 1), t[0], rotation(1, 0),
                                   rotation(1, 1), t[1], rotation(2, 0), rotation(2, 1), t[2]);
  const double scale = kPaperPxPerMetre;
  const double shift = layout_.square_m * scale - 0.5;  // To the centre of the paper's first pixel.
  const cv::Matx33d paper_from_board(scale, 0, shift, 0, scale, shift, 0, 0, 1);
  cv::Mat on_paper;
  cv::perspectiveTransform(rays, on_paper, paper_from_board * ray_from_board.inv());
  cv::Mat picture;
  cv::remap(paper_, picture, on_paper, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, kGrey);
  return picture;
}

cv::Mat BoardCamera::Take(const BoardPose& pose) const {
  cv::Mat sum = cv::Mat::zeros(lens_.size, CV_32F);
  for (const cv::Mat& rays : rays_) {
    cv::Mat picture;
    TakeOnce(pose, rays).convertTo(picture, CV_32F, 0.7 / static_cast<double>(rays_.size()), 8.0);
    sum += picture;
  }
  cv::GaussianBlur(sum, sum, {5, 5}, 0.7);
  cv::Mat noise(sum.size(), CV_32F);
  cv::RNG random(7);
  random.fill(noise, cv::RNG::NORMAL, 0.0, 2.0);
  cv::Mat grey;
  cv::Mat(sum + noise).convertTo(grey, CV_8U);
  cv::Mat bgr;
  cv::cvtColor(grey, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

Corners ProjectedCorners(const Lens& lens, const BoardLayout& layout, const BoardPose& pose,
                         double sigma_px, cv::RNG& random) {
  Corners corners;
  corners.points_px = Project(lens, layout.corners_m, pose);
  for (cv::Point2f& point : corners.points_px) {
    point.x += static_cast<float>(random.gaussian(sigma_px));
    point.y += static_cast<float>(random.gaussian(sigma_px));
  }
  corners.ids.resize(corners.points_px.size());
  std::iota(corners.ids.begin(), corners.ids.end(), 0);
  return corners;
}

}  // namespace deixis::calibrator::test
