#include "test/benchmark/geometry/single_start_search.h"

#include <algorithm>
#include <cmath>

namespace deixis::geometry {
namespace {

using Eigen::Vector3d;

constexpr int kMostSteps = 30;
constexpr double kLargestStep_rad = 0.3;
constexpr double kConverged = 1e-2;  // Of the last step: errors are below FindClosestPoints' then.
constexpr double kOnSurface_m = 1e-9;

/// Ellipse at one share of the length, and the point in its frame.
struct Slice {
  double a, b, x, y;
};

Slice SliceAt(const DegenerateCylinder& cylinder, const Vector3d& p, double share) {
  const double rest = 1.0 - share;
  return {rest * cylinder.a0_m + share * cylinder.a1_m,
          rest * cylinder.b0_m + share * cylinder.b1_m,
          p.x() - rest * cylinder.centre0_m.x() - share * cylinder.centre1_m.x(),
          p.y() - rest * cylinder.centre0_m.y() - share * cylinder.centre1_m.y()};
}

bool IsInside(const Slice& slice) {
  const double u = slice.x / slice.a, v = slice.y / slice.b;
  return u * u + v * v <= 1.0;
}

/// A point of the side: cosine and sine of its angle, its share of the length.
struct Place {
  double c, s, share;
};

Place Start(const Slice& slice, double share) {
  const double u = slice.x / slice.a, v = slice.y / slice.b, norm = std::hypot(u, v);
  if (norm > 1e-12) return {u / norm, v / norm, share};
  return slice.a < slice.b ? Place{1.0, 0.0, share} : Place{0.0, 1.0, share};
}

Vector3d Generator(const DegenerateCylinder& cylinder, const Place& at) {
  const Eigen::Vector2d drift = cylinder.centre1_m - cylinder.centre0_m;
  return {drift.x() + (cylinder.a1_m - cylinder.a0_m) * at.c,
          drift.y() + (cylinder.b1_m - cylinder.b0_m) * at.s, cylinder.length_m};
}

double BestShare(const DegenerateCylinder& cylinder, const Vector3d& p, const Place& at) {
  const Vector3d generator = Generator(cylinder, at);
  const Vector3d from_begin(p.x() - cylinder.centre0_m.x() - cylinder.a0_m * at.c,
                            p.y() - cylinder.centre0_m.y() - cylinder.b0_m * at.s, p.z());
  return std::clamp(from_begin.dot(generator) / generator.squaredNorm(), 0.0, 1.0);
}

/// Towards the least squared distance over the angle, in the quadrant of the point.
double StepOf(const Slice& slice, const Place& at) {
  // Derivatives of half the squared distance.
  const double flatness = slice.b * slice.b - slice.a * slice.a;
  const double ax = slice.a * slice.x, by = slice.b * slice.y;
  const double first = flatness * at.s * at.c + ax * at.s - by * at.c;
  const double second = flatness * (at.c * at.c - at.s * at.s) + ax * at.c + by * at.s;
  const double step = second > 0.0 ? -first / second : std::copysign(kLargestStep_rad, -first);
  return std::clamp(step, -kLargestStep_rad, kLargestStep_rad);
}

Place Turned(const Slice& slice, const Place& at, double step) {
  double c = at.c - step * at.s - 0.5 * step * step * at.c;
  double s = at.s + step * at.c - 0.5 * step * step * at.s;
  if (c * slice.x < 0.0) c = 0.0;
  if (s * slice.y < 0.0) s = 0.0;
  const double norm = std::sqrt(c * c + s * s);
  return {c / norm, s / norm, at.share};
}

Place SearchSide(const DegenerateCylinder& cylinder, const Vector3d& p, double share) {
  Slice slice = SliceAt(cylinder, p, share);
  Place at = Start(slice, share);
  for (int i = 0; i < kMostSteps; ++i) {
    Place next = Turned(slice, at, StepOf(slice, at));
    next.share = BestShare(cylinder, p, next);
    const double moved =
        std::abs(next.c - at.c) + std::abs(next.s - at.s) + std::abs(next.share - at.share);
    at = next;
    slice = SliceAt(cylinder, p, at.share);
    if (moved < kConverged) break;
  }
  return at;
}

Vector3d SideNormalAt(const DegenerateCylinder& cylinder, const Slice& slice, const Place& at) {
  const Vector3d g = Generator(cylinder, at);
  return Vector3d(slice.b * at.c * g.z(), slice.a * at.s * g.z(),
                  -slice.a * at.s * g.y() - slice.b * at.c * g.x())
      .normalized();
}

}  // namespace

DistanceAndNormal FindClosestFromOneStart(const DegenerateCylinder& cylinder, const Vector3d& p) {
  const double share = p.z() / cylinder.length_m;
  const Place at = SearchSide(cylinder, p, std::clamp(share, 0.0, 1.0));
  const Slice slice = SliceAt(cylinder, p, at.share);
  Vector3d to_point(slice.x - slice.a * at.c, slice.y - slice.b * at.s,
                    p.z() - at.share * cylinder.length_m);
  double distance_m = to_point.norm();
  Vector3d on_surface = SideNormalAt(cylinder, slice, at);
  for (const double end : {0.0, 1.0}) {
    const double height_m = p.z() - end * cylinder.length_m;
    if (std::abs(height_m) > distance_m || !IsInside(SliceAt(cylinder, p, end))) continue;
    distance_m = std::abs(height_m);
    to_point = {0.0, 0.0, height_m};
    on_surface = {0.0, 0.0, 2.0 * end - 1.0};
  }
  const bool is_inside = share >= 0.0 && share <= 1.0 && IsInside(SliceAt(cylinder, p, share));
  const double signed_m = is_inside ? -distance_m : distance_m;
  return {signed_m, distance_m > kOnSurface_m ? Vector3d(to_point / signed_m) : on_surface};
}

}  // namespace deixis::geometry
