#include "services/pose_fitter/core/people/people_finder.h"

#include <cmath>
#include <random>

namespace deixis::pose_fitter {
namespace {
using Eigen::Vector3d;
std::optional<body_model::Floor> FloorOf(const DepthView& view) {
  std::vector<Vector3d> points;
  for (int v = view.height_px() / 3; v < view.height_px(); v += 4)
    for (int u = 0; u < view.width_px(); u += 4)
      if (view.z_m(u, v) > 0.5F && view.z_m(u, v) < 6.0F) points.push_back(view.Point(u, v));
  if (points.size() < 50) return std::nullopt;
  std::mt19937 random(1);
  body_model::Floor best;
  double most = 0;
  for (int k = 0; k < 400; ++k) {
    const auto pick = [&] { return points[random() % points.size()]; };
    const Vector3d a = pick(), b = pick(), c = pick();
    Vector3d n = (b - a).cross(c - a);
    if (n.norm() < 1e-3) continue;
    n.normalize();
    if (n.y() > 0) n = -n;
    if (n.y() > -0.8) continue;
    const double d = -n.dot(a);
    double count = 0;
    for (const auto& p : points) {
      const double h = n.dot(p) + d;
      const double t = 0.01 + 0.006 * p.z() * p.z();
      if (std::abs(h) < t)
        count += 1;
      else if (h < -2 * t)
        count -= 1;
    }
    if (count > most) {
      most = count;
      best = {n, d};
    }
  }
  if (most < 50) return std::nullopt;
  return best;
}
}  // namespace

PeopleRegions FindPeople(const DepthView& view, std::optional<body_model::Floor> floor) {
  PeopleRegions out;
  if (!floor) floor = FloorOf(view);
  out.floor = floor;
  const int w = view.width_px(), h = view.height_px();
  out.labels.assign(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), 0);
  std::vector<int> seen(out.labels.size(), 0), stack;
  auto ok = [&](int i) {
    const int u = i % w, v = i / w;
    const float z = view.z_m(u, v);
    if (z < 0.5F || z > 4.5F) return false;
    if (!floor) return true;
    const double height = floor->normal.dot(view.Point(u, v)) + floor->offset_m;
    return height > 0.05 && height < 2.3;
  };
  int label = 0;
  for (int s = 0; s < w * h; ++s) {
    if (seen[static_cast<std::size_t>(s)] || !ok(s)) continue;
    stack.assign(1, s);
    seen[static_cast<std::size_t>(s)] = 1;
    for (std::size_t k = 0; k < stack.size(); ++k) {
      const int i = stack[k], u = i % w, v = i / w;
      const int nb[4] = {u > 0 ? i - 1 : -1, u < w - 1 ? i + 1 : -1, v > 0 ? i - w : -1,
                         v < h - 1 ? i + w : -1};
      for (int q : nb) {
        if (q < 0 || seen[static_cast<std::size_t>(q)] || !ok(q)) continue;
        const float z = view.z_m(u, v);
        if (std::abs(view.z_m(q % w, q / w) - z) > 0.02F + 0.015F * z * z) continue;
        seen[static_cast<std::size_t>(q)] = 1;
        stack.push_back(q);
      }
    }
    if (stack.size() < 1500) continue;
    PersonRegion r;
    r.pixel_count = static_cast<int>(stack.size());
    double top = 0, left = 1e9, right = -1e9;
    for (int i : stack) {
      const Vector3d p = view.Point(i % w, i / w);
      r.centroid_m += p;
      top = std::max(top, floor ? floor->normal.dot(p) + floor->offset_m : -p.y());
      left = std::min(left, p.x());
      right = std::max(right, p.x());
    }
    r.centroid_m /= r.pixel_count;
    r.top_m = top;
    if (top < 1.0 || top > 2.1 || right - left > 2.0 || label > 250) continue;
    r.label = ++label;
    for (int i : stack) out.labels[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(label);
    out.regions.push_back(r);
  }
  return out;
}

}  // namespace deixis::pose_fitter
