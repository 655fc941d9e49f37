#include "common/geometry/degenerate_cylinder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace deixis::geometry {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kStarts = 16;
constexpr int kMostSteps = 60;
constexpr double kConverged = 1e-15;  // Square of the last step's angle, radians.
constexpr double kOnSurface_m = 1e-12;

/// What the side looks like at one share of the length.
struct Ellipse {
  double a_m, b_m;
  Vector2d centre_m;
};

Ellipse At(const DegenerateCylinder& cylinder, double s) {
  return {cylinder.a0_m + s * (cylinder.a1_m - cylinder.a0_m),
          cylinder.b0_m + s * (cylinder.b1_m - cylinder.b0_m),
          cylinder.centre0_m + s * (cylinder.centre1_m - cylinder.centre0_m)};
}

bool IsInside(const Ellipse& ellipse, const Vector2d& point_m) {
  const Vector2d offset = point_m - ellipse.centre_m;
  const double u = offset.x() / ellipse.a_m;
  const double v = offset.y() / ellipse.b_m;
  return u * u + v * v <= 1.0;
}

Vector3d PointAt(const DegenerateCylinder& cylinder, const Vector2d& direction, double s) {
  const Ellipse ellipse = At(cylinder, s);
  return {ellipse.centre_m.x() + ellipse.a_m * direction.x(),
          ellipse.centre_m.y() + ellipse.b_m * direction.y(), s * cylinder.length_m};
}

/// Derivative of the side by s: along the straight line of one angle.
Vector3d Generator(const DegenerateCylinder& cylinder, const Vector2d& direction) {
  const Vector2d drift = cylinder.centre1_m - cylinder.centre0_m;
  return {drift.x() + (cylinder.a1_m - cylinder.a0_m) * direction.x(),
          drift.y() + (cylinder.b1_m - cylinder.b0_m) * direction.y(), cylinder.length_m};
}

Vector3d NormalAt(const DegenerateCylinder& cylinder, const Vector2d& direction, double s) {
  const Ellipse ellipse = At(cylinder, s);
  const Vector3d around(-ellipse.a_m * direction.y(), ellipse.b_m * direction.x(), 0.0);
  return around.cross(Generator(cylinder, direction)).normalized();
}

/// The nearest point on the line of one angle, and what a search over angles needs there.
struct Foot {
  double s = 0.0;
  double squared_m2 = 0.0;
  Vector3d residual_m;  ///< From the foot to the point.
  Vector3d generator_m;
};

Foot FootOn(const DegenerateCylinder& cylinder, const Vector3d& point_m,
            const Vector2d& direction) {
  Foot foot;
  foot.generator_m = Generator(cylinder, direction);
  const Vector3d from_begin = point_m - PointAt(cylinder, direction, 0.0);
  const double s = from_begin.dot(foot.generator_m) / foot.generator_m.squaredNorm();
  foot.s = std::clamp(s, 0.0, 1.0);
  foot.residual_m = from_begin - foot.s * foot.generator_m;
  foot.squared_m2 = foot.residual_m.squaredNorm();
  return foot;
}

/// Derivatives by the angle of half the squared distance, the share being the best for each angle.
struct Slope {
  double first, second;
};

Slope SlopeAt(const DegenerateCylinder& cylinder, const Vector2d& direction, const Foot& foot) {
  const Ellipse ellipse = At(cylinder, foot.s);
  const double c = direction.x(), s = direction.y();
  const Vector3d around(-ellipse.a_m * s, ellipse.b_m * c, 0.0);
  const Vector3d curved(-ellipse.a_m * c, -ellipse.b_m * s, 0.0);
  Slope slope{-foot.residual_m.dot(around), around.squaredNorm() - foot.residual_m.dot(curved)};
  if (foot.s > 0.0 && foot.s < 1.0) {
    const Vector3d mixed(-(cylinder.a1_m - cylinder.a0_m) * s, (cylinder.b1_m - cylinder.b0_m) * c,
                         0.0);
    const double cross = around.dot(foot.generator_m) - foot.residual_m.dot(mixed);
    slope.second -= cross * cross / foot.generator_m.squaredNorm();
  }
  return slope;
}

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// `direction` turned by nearly `angle_rad`, for small ones.
Vector2d Turned(const Vector2d& direction, double angle_rad) {
  const double half = 0.5 * angle_rad;
  const double scale = 1.0 / (1.0 + half * half);
  const double c = (1.0 - half * half) * scale, s = 2.0 * half * scale;
  return {c * direction.x() - s * direction.y(), s * direction.x() + c * direction.y()};
}

const std::array<Vector2d, kStarts>& Starts() {
  static const std::array<Vector2d, kStarts> starts = [] {
    std::array<Vector2d, kStarts> all;
    for (int i = 0; i < kStarts; ++i) {
      const double phi = 2.0 * M_PI * i / kStarts;
      all[static_cast<std::size_t>(i)] = {std::cos(phi), std::sin(phi)};
    }
    return all;
  }();
  return starts;
}

struct SideFoot {
  Vector2d direction = Vector2d::UnitX();  ///< cos phi, sin phi
  Foot foot;
};

/// Newton's method between two angles that enclose a minimum, with bisection where it leaves them.
SideFoot Refined(const DegenerateCylinder& cylinder, const Vector3d& point_m, Vector2d low,
                 Vector2d direction, Vector2d high) {
  Foot foot = FootOn(cylinder, point_m, direction);
  for (int i = 0; i < kMostSteps; ++i) {
    const Slope slope = SlopeAt(cylinder, direction, foot);
    (slope.first > 0.0 ? high : low) = direction;
    Vector2d next = slope.second > 0.0 ? Turned(direction, -slope.first / slope.second)
                                       : Vector2d::Zero().eval();
    const bool is_enclosed = Cross(low, next) >= 0.0 && Cross(next, high) >= 0.0;
    if (!is_enclosed || next.isZero()) next = (low + high).normalized();
    const double step2 = (next - direction).squaredNorm();
    direction = next;
    foot = FootOn(cylinder, point_m, direction);
    if (step2 < kConverged) break;
  }
  return {direction, foot};
}

/// The nearest point of the side. Its squared distance has up to four minima over the angle: of
/// each that the starts enclose, the least counts.
SideFoot NearestOnSide(const DegenerateCylinder& cylinder, const Vector3d& point_m) {
  std::array<double, kStarts> squared_m2;
  for (std::size_t i = 0; i < kStarts; ++i) {
    squared_m2[i] = FootOn(cylinder, point_m, Starts()[i]).squared_m2;
  }
  SideFoot nearest;
  nearest.foot.squared_m2 = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < kStarts; ++i) {
    const std::size_t before = (i + kStarts - 1) % kStarts, after = (i + 1) % kStarts;
    if (squared_m2[i] > squared_m2[before] || squared_m2[i] > squared_m2[after]) continue;
    const SideFoot found =
        Refined(cylinder, point_m, Starts()[before], Starts()[i], Starts()[after]);
    if (found.foot.squared_m2 < nearest.foot.squared_m2) nearest = found;
  }
  return nearest;
}

}  // namespace

Vector3d SidePoint(const DegenerateCylinder& cylinder, double phi_rad, double s) {
  return PointAt(cylinder, {std::cos(phi_rad), std::sin(phi_rad)}, s);
}

Vector3d SideNormal(const DegenerateCylinder& cylinder, double phi_rad, double s) {
  return NormalAt(cylinder, {std::cos(phi_rad), std::sin(phi_rad)}, s);
}

bool IsInside(const DegenerateCylinder& cylinder, const Vector3d& point_m) {
  if (point_m.z() < 0.0 || point_m.z() > cylinder.length_m) return false;
  return IsInside(At(cylinder, point_m.z() / cylinder.length_m), point_m.head<2>());
}

ClosestPoint FindClosest(const DegenerateCylinder& cylinder, const Vector3d& point_m) {
  const SideFoot side = NearestOnSide(cylinder, point_m);
  ClosestPoint closest;
  closest.point_m = PointAt(cylinder, side.direction, side.foot.s);
  closest.normal = NormalAt(cylinder, side.direction, side.foot.s);
  double distance_m = std::sqrt(side.foot.squared_m2);
  const double ends_m[2] = {0.0, cylinder.length_m};
  for (const int end : {0, 1}) {
    const double height_m = std::abs(point_m.z() - ends_m[end]);
    if (height_m > distance_m || !IsInside(At(cylinder, end), point_m.head<2>())) continue;
    closest.point_m = {point_m.x(), point_m.y(), ends_m[end]};
    closest.normal = {0.0, 0.0, end == 0 ? -1.0 : 1.0};
    closest.part = end == 0 ? CylinderPart::kProximalDisc : CylinderPart::kDistalDisc;
    distance_m = height_m;
  }
  closest.signed_distance_m = IsInside(cylinder, point_m) ? -distance_m : distance_m;
  if (distance_m > kOnSurface_m) {
    closest.normal = (point_m - closest.point_m) / closest.signed_distance_m;
  }
  return closest;
}

}  // namespace deixis::geometry
