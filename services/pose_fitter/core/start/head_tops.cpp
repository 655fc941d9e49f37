#include "services/pose_fitter/core/start/head_tops.h"

#include <algorithm>
#include <cmath>

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector3d;

/// The highest point of a region in one column of the image.
struct ColumnTop {
  double height_m = -1e9;  ///< Along the vertical; from no certain level.
  int v_px = 0;
  Vector3d point_m = Vector3d::Zero();
  bool is_there = false;
};

bool IsOf(const DepthView& view, const PeopleRegions& regions, int label, int u, int v) {
  const auto pixel = static_cast<std::size_t>(v * view.width_px() + u);
  return regions.labels[pixel] == label && view.z_m(u, v) > 0.0F;
}

std::vector<ColumnTop> OutlineOf(const DepthView& view, const PeopleRegions& regions,
                                 const PersonRegion& region, const Vector3d& up) {
  const cv::Rect& box = region.box_px;
  std::vector<ColumnTop> tops(static_cast<std::size_t>(box.width));
  for (int u = 0; u < box.width; ++u) {
    for (int v = box.y; v < box.y + box.height; ++v) {
      if (!IsOf(view, regions, region.label, box.x + u, v)) continue;
      const Vector3d point_m = view.Point(box.x + u, v);
      tops[static_cast<std::size_t>(u)] = {up.dot(point_m), v, point_m, true};
      break;
    }
  }
  return tops;
}

/// Whether the outline falls from column `u` on both sides, and rises nowhere within reach.
bool IsPeak(const std::vector<ColumnTop>& tops, int u, int reach_px, double drop_m) {
  const double top_m = tops[static_cast<std::size_t>(u)].height_m;
  for (const int side : {-1, 1}) {
    bool falls = false;
    for (int k = 1; k <= reach_px && !falls; ++k) {
      const int at = u + side * k;
      const bool is_beside = at < 0 || at >= static_cast<int>(tops.size());
      const double there_m = is_beside ? -1e9 : tops[static_cast<std::size_t>(at)].height_m;
      if (there_m > top_m || (side < 0 && there_m == top_m)) return false;
      falls = there_m < top_m - drop_m;
    }
    if (!falls) return false;
  }
  return true;
}

/// Of the surface around a peak, as high as a head.
Vector3d MiddleOf(const DepthView& view, const PeopleRegions& regions, const PersonRegion& region,
                  const ColumnTop& peak, const Vector3d& up, const HeadTopsConfig& config) {
  const double px_per_m = view.camera().focal_px.x() / peak.point_m.z();
  const int reach_px = static_cast<int>(std::ceil(0.5 * config.reach_m * px_per_m));
  const int high_px = static_cast<int>(std::ceil(1.5 * config.height_m * px_per_m));
  const Eigen::Vector2d at = view.camera().Project(peak.point_m);
  const cv::Rect box =
      cv::Rect(static_cast<int>(at.x()) - reach_px, peak.v_px, 2 * reach_px + 1, high_px) &
      region.box_px;
  Vector3d sum_m = Vector3d::Zero();
  int count = 0;
  for (int v = box.y; v < box.y + box.height; ++v) {
    for (int u = box.x; u < box.x + box.width; ++u) {
      if (!IsOf(view, regions, region.label, u, v)) continue;
      const Vector3d point_m = view.Point(u, v);
      if (up.dot(point_m) < peak.height_m - config.height_m ||
          std::abs(point_m.z() - peak.point_m.z()) > config.reach_m) {
        continue;
      }
      sum_m += point_m;
      ++count;
    }
  }
  const Vector3d middle_m = count > 0 ? Vector3d(sum_m / count) : peak.point_m;
  return middle_m + (peak.height_m - up.dot(middle_m)) * up;
}

}  // namespace

void HeadTopsConfig::Validate() const {
  config::Faults faults;
  faults.Require(height_m > 0.0, "height_m", "must be positive");
  faults.Require(reach_m > 0.0, "reach_m", "must be positive");
  faults.Require(drop_m > 0.0, "drop_m", "must be positive");
  faults.Require(most >= 1 && most <= 100, "most", "must be 1..100");
  faults.ThrowIfAny();
}

std::vector<Vector3d> HeadTops(const DepthView& view, const PeopleRegions& regions,
                               const PersonRegion& region, const HeadTopsConfig& config) {
  const Vector3d up = regions.floor ? regions.floor->normal : Vector3d(-Vector3d::UnitY());
  const auto tops = OutlineOf(view, regions, region, up);
  std::vector<ColumnTop> peaks;
  for (int u = 0; u < static_cast<int>(tops.size()); ++u) {
    const ColumnTop& top = tops[static_cast<std::size_t>(u)];
    if (!top.is_there) continue;
    const double px_per_m = view.camera().focal_px.x() / top.point_m.z();
    const int reach_px = std::max(2, static_cast<int>(config.reach_m * px_per_m));
    if (IsPeak(tops, u, reach_px, config.drop_m)) peaks.push_back(top);
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const ColumnTop& a, const ColumnTop& b) { return a.height_m > b.height_m; });
  std::vector<Vector3d> heads;
  for (const ColumnTop& peak : peaks) {
    if (static_cast<int>(heads.size()) == config.most) break;
    heads.push_back(MiddleOf(view, regions, region, peak, up, config));
  }
  return heads;
}

}  // namespace deixis::pose_fitter
