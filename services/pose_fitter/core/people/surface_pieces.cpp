#include "services/pose_fitter/core/people/surface_pieces.h"

#include <algorithm>
#include <cmath>

namespace deixis::pose_fitter {
namespace {

constexpr int kSamplesPerRow = 40;  // Of the picture: neighbours tell the same.
constexpr int kGap_px = 6;          // Half-occluded and flying pixels between two surfaces.
constexpr int kGapRows_px = 3;
constexpr int kReachRows = 60;  // Of a picture: so near are a level surface and what stands on it.
constexpr float kSameDepth_m = 0.12F;
constexpr double kLowestTop_m = 0.15;  // What is level below this is the floor with its noise.
constexpr double kEnd_m = 0.04;        // Lowest and highest part of a piece.
constexpr double kAtTop = 0.3;         // Share of it that must meet a level surface.

}  // namespace

RoomFrame RoomFrameOf(const Eigen::Vector3d& up, double camera_height_m) {
  // Ahead: the optical axis, or when that is nearly vertical the picture's upward direction.
  Eigen::Vector3d ahead = Eigen::Vector3d::UnitZ() - up * up.z();
  if (ahead.norm() < 0.1) ahead = -Eigen::Vector3d::UnitY() + up * up.y();
  ahead.normalize();
  RoomFrame room;
  room.room_from_camera.row(0) = ahead.cross(up).transpose();
  room.room_from_camera.row(1) = ahead.transpose();
  room.room_from_camera.row(2) = up.transpose();
  room.camera_height_m = camera_height_m;
  return room;
}

void SurfaceShape::Add(const Eigen::Vector3d& point_m, double pixel_count, double pixel_area_m2,
                       double depth_sigma_m) {
  pixels += pixel_count;
  area_m2 += pixel_count * pixel_area_m2;
  sum_m += pixel_count * point_m;
  square_m2.noalias() += pixel_count * point_m * point_m.transpose();
  lowest_m = lowest_m.cwiseMin(point_m);
  highest_m = highest_m.cwiseMax(point_m);
  sigma_m += pixel_count * depth_sigma_m;
}

void SurfaceShape::Add(const SurfaceShape& other) {
  pixels += other.pixels;
  area_m2 += other.area_m2;
  sum_m += other.sum_m;
  square_m2 += other.square_m2;
  lowest_m = lowest_m.cwiseMin(other.lowest_m);
  highest_m = highest_m.cwiseMax(other.highest_m);
  sigma_m += other.sigma_m;
}

Eigen::Matrix3d SurfaceShape::Covariance() const {
  const Eigen::Vector3d mean = Mean();
  return square_m2 / pixels - mean * mean.transpose();
}

SurfacePieces::SurfacePieces() : contacts_(static_cast<std::size_t>(kMost * kMost)) {
  shapes_.reserve(kMost);
  is_at_top_.reserve(kMost);
  ends_.reserve(kMost);
}

void SurfacePieces::Find(const DepthView& depth, const RoomFrame& room, double least_m2,
                         double largest_m2, const std::vector<std::uint8_t>& is_level,
                         SurfaceRuns& runs) {
  const std::size_t capacity = runs.runs().capacity();
  areas_.reserve(capacity);
  order_.reserve(capacity);
  numbers_.reserve(capacity);
  areas_.assign(runs.runs().size(), 0.0F);
  const auto per_pixel = static_cast<float>(1.0 / depth.camera().focal_px.prod());
  for (const SurfaceRun& run : runs.runs()) {
    const float z = depth.z_m((run.begin_px + run.end_px) / 2, run.row_px);
    areas_[static_cast<std::size_t>(run.component)] +=
        per_pixel * z * z * static_cast<float>(run.end_px - run.begin_px);
  }
  Choose(least_m2, largest_m2, runs);
  Measure(depth, room, runs);
  FindAtTops(depth, room, is_level, runs);
  FindContacts(depth, runs);
}

void SurfacePieces::Choose(double least_m2, double largest_m2, SurfaceRuns& runs) {
  order_.clear();
  for (std::size_t i = 0; i < areas_.size(); ++i) {
    const auto area_m2 = static_cast<double>(areas_[i]);
    if (area_m2 >= least_m2 && area_m2 <= largest_m2) order_.push_back(static_cast<int>(i));
  }
  const auto area = [this](int i) { return areas_[static_cast<std::size_t>(i)]; };
  std::sort(order_.begin(), order_.end(),
            [&](int a, int b) { return area(a) != area(b) ? area(a) > area(b) : a < b; });
  if (order_.size() > kMost) order_.resize(kMost);
  numbers_.assign(areas_.size(), -1);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    numbers_[static_cast<std::size_t>(order_[i])] = static_cast<int>(i);
  }
  for (SurfaceRun& run : runs.runs()) {
    run.component = numbers_[static_cast<std::size_t>(run.component)];
  }
}

void SurfacePieces::Measure(const DepthView& depth, const RoomFrame& room,
                            const SurfaceRuns& runs) {
  shapes_.assign(order_.size(), {});
  const double per_pixel = 1.0 / depth.camera().focal_px.prod();
  const int every_px = std::max(1, depth.width_px() / kSamplesPerRow);
  for (const SurfaceRun& run : runs.runs()) {
    if (run.component < 0) continue;
    SurfaceShape& shape = shapes_[static_cast<std::size_t>(run.component)];
    const int length = run.end_px - run.begin_px;
    const int samples = 1 + (length - 1) / every_px;
    const auto middle_m =
        static_cast<double>(depth.z_m((run.begin_px + run.end_px) / 2, run.row_px));
    const double sigma_m = depth.camera().noise.Sigma_m(middle_m);
    for (int i = 0; i < samples; ++i) {
      const int u = run.begin_px + (2 * i + 1) * length / (2 * samples);
      const Eigen::Vector3d point_m = depth.Point(u, run.row_px);
      shape.Add(room.FromCamera(point_m), static_cast<double>(length) / samples,
                per_pixel * point_m.z() * point_m.z(), sigma_m);
    }
  }
}

void SurfacePieces::FindAtTops(const DepthView& depth, const RoomFrame& room,
                               const std::vector<std::uint8_t>& is_level, const SurfaceRuns& runs) {
  const int reach_px = std::max(2, depth.height_px() / kReachRows);
  const auto meets_level = [&](const SurfaceRun& run, int step) {
    const int u = (run.begin_px + run.end_px) / 2;
    const float z = depth.z_m(u, run.row_px);
    for (int i = 1; i <= reach_px; ++i) {
      const int v = run.row_px + step * i;
      if (v < 0 || v >= depth.height_px()) return false;
      const bool is_near = std::abs(depth.z_m(u, v) - z) < kSameDepth_m;
      if (is_near && is_level[static_cast<std::size_t>(v * depth.width_px() + u)] != 0) return true;
    }
    return false;
  };
  ends_.assign(shapes_.size(), {});
  for (const SurfaceRun& run : runs.runs()) {
    if (run.component < 0) continue;
    const SurfaceShape& shape = shapes_[static_cast<std::size_t>(run.component)];
    auto& ends = ends_[static_cast<std::size_t>(run.component)];
    const double height_m =
        room.FromCamera(depth.Point((run.begin_px + run.end_px) / 2, run.row_px)).z();
    if (height_m < kLowestTop_m) continue;
    const int length = run.end_px - run.begin_px;
    if (height_m < shape.lowest_m.z() + kEnd_m) {
      ends[0] += length;
      ends[1] += meets_level(run, 1) ? length : 0;
    }
    if (height_m > shape.highest_m.z() - kEnd_m) {
      ends[2] += length;
      ends[3] += meets_level(run, -1) ? length : 0;
    }
  }
  is_at_top_.clear();
  for (const auto& ends : ends_) {
    is_at_top_.push_back(ends[1] > kAtTop * ends[0] || ends[3] > kAtTop * ends[2] ? 1 : 0);
  }
}

void SurfacePieces::Touch(int a, int b, float step_m) {
  for (Contact* contact : {&contacts_[static_cast<std::size_t>(a * kMost + b)],
                           &contacts_[static_cast<std::size_t>(b * kMost + a)]}) {
    ++contact->count;
    contact->sum_step_m += std::abs(step_m);
  }
}

void SurfacePieces::FindContacts(const DepthView& depth, const SurfaceRuns& runs) {
  std::fill(contacts_.begin(), contacts_.end(), Contact{});
  for (int i = 0; i < static_cast<int>(runs.runs().size()); ++i) {
    if (runs.runs()[static_cast<std::size_t>(i)].component < 0) continue;
    TouchLeft(depth, runs, i);
    TouchAbove(depth, runs, i);
  }
}

/// The nearest run to the left, if it is near.
void SurfacePieces::TouchLeft(const DepthView& depth, const SurfaceRuns& runs, int number) {
  const SurfaceRun& run = runs.runs()[static_cast<std::size_t>(number)];
  for (int i = number - 1; i >= runs.RowBegin(run.row_px); --i) {
    const SurfaceRun& left = runs.runs()[static_cast<std::size_t>(i)];
    if (run.begin_px - left.end_px > kGap_px) return;
    if (left.component < 0) continue;
    if (left.component != run.component) {
      Touch(left.component, run.component,
            depth.z_m(left.end_px - 1, run.row_px) - depth.z_m(run.begin_px, run.row_px));
    }
    return;
  }
}

/// All runs above, beyond what a border makes unsound.
void SurfacePieces::TouchAbove(const DepthView& depth, const SurfaceRuns& runs, int number) {
  const SurfaceRun& run = runs.runs()[static_cast<std::size_t>(number)];
  const int row = run.row_px - kGapRows_px;
  if (row < 0) return;
  for (int i = runs.RowBegin(row); i < runs.RowBegin(row + 1); ++i) {
    const SurfaceRun& above = runs.runs()[static_cast<std::size_t>(i)];
    if (above.begin_px >= run.end_px) return;
    const int begin = std::max(above.begin_px, run.begin_px);
    const int end = std::min(above.end_px, run.end_px);
    if (above.component < 0 || above.component == run.component || begin >= end) continue;
    const int u = (begin + end) / 2;
    Touch(above.component, run.component, depth.z_m(u, row) - depth.z_m(u, run.row_px));
  }
}

}  // namespace deixis::pose_fitter
