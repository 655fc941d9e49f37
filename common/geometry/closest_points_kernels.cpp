// The hot loop of closest_points.h; compiled with the kernel flags.
#include <cmath>

#include "common/geometry/closest_points.h"
#include "common/kernels/kernel.h"

namespace deixis::geometry {
namespace {

constexpr int kSteps = 2;
constexpr float kTiny = 1e-20F;
constexpr float kOnSurface_m = 1e-5F;  // Below, the direction to the point is noise.

/// The cylinder in single precision: value at the proximal end and change along the whole length.
struct Shape {
  float a0, b0, x0, y0, da, db, dx, dy, length, per_length;
};

Shape ShapeOf(const DegenerateCylinder& cylinder) {
  const auto f = [](double value) { return static_cast<float>(value); };
  return {f(cylinder.a0_m),
          f(cylinder.b0_m),
          f(cylinder.centre0_m[0]),
          f(cylinder.centre0_m[1]),
          f(cylinder.a1_m - cylinder.a0_m),
          f(cylinder.b1_m - cylinder.b0_m),
          f(cylinder.centre1_m[0] - cylinder.centre0_m[0]),
          f(cylinder.centre1_m[1] - cylinder.centre0_m[1]),
          f(cylinder.length_m),
          f(1.0 / cylinder.length_m)};
}

struct Vector {
  float x, y, z;
};

struct Closest {
  Vector to_point;  ///< From the foot.
  Vector normal;    ///< Of the surface at the foot.
  float squared;    ///< Distance.
};

[[gnu::always_inline]] inline float Clamped(float s) {
  const float positive = s > 0.0F ? s : 0.0F;
  return positive < 1.0F ? positive : 1.0F;
}

/// Cosine and sine of the angle of a point of the side, and its share of the length.
struct Place {
  float c, s, share;
};

/// Of a point, in the ellipse at a share made the unit circle: its square's distance from the
/// centre.
struct InCircle {
  float u, v, squared;
};

[[gnu::always_inline]] inline InCircle Normalised(const Shape& shape, const Vector& p,
                                                  float share) {
  const float a = shape.a0 + share * shape.da, b = shape.b0 + share * shape.db;
  const float per_ab = 1.0F / (a * b);
  const float u = (p.x - shape.x0 - share * shape.dx) * b * per_ab;
  const float v = (p.y - shape.y0 - share * shape.dy) * a * per_ab;
  return {u, v, u * u + v * v};
}

/// The nearest point on the straight line of one angle.
[[gnu::always_inline]] inline float ShareOn(const Shape& shape, const Vector& p, float c, float s) {
  const float gx = shape.dx + shape.da * c, gy = shape.dy + shape.db * s;
  const float px = p.x - shape.x0 - shape.a0 * c, py = p.y - shape.y0 - shape.b0 * s;
  return Clamped((px * gx + py * gy + p.z * shape.length) /
                 (gx * gx + gy * gy + shape.length * shape.length));
}

/// One step towards the nearest point of the ellipse at the share: along the circle that touches it
/// at the angle so far, around its centre of curvature.
[[gnu::always_inline]] inline Place Stepped(const Shape& shape, const Vector& p, const Place& at) {
  const float a = shape.a0 + at.share * shape.da, b = shape.b0 + at.share * shape.db;
  const float x = p.x - shape.x0 - at.share * shape.dx, y = p.y - shape.y0 - at.share * shape.dy;
  const float per_ab = 1.0F / (a * b), ia = b * per_ab, ib = a * per_ab, e = a * a - b * b;
  const float mx = e * at.c * at.c * at.c * ia, my = -e * at.s * at.s * at.s * ib;
  const float rx = a * at.c - mx, ry = b * at.s - my, qx = x - mx, qy = y - my;
  const float stretch = std::sqrt((rx * rx + ry * ry) / (qx * qx + qy * qy + kTiny));
  float c = (qx * stretch + mx) * ia, s = (qy * stretch + my) * ib;
  // The foot stays in the point's quadrant; near the medial axis neither may be left.
  c = c * x < 0.0F ? 0.0F : c;
  s = s * y < 0.0F ? 0.0F : s;
  const float squared = c * c + s * s;
  const bool is_lost = squared < 1e-12F;
  c = is_lost ? at.c : c;
  s = is_lost ? at.s : s;
  const float scale = 1.0F / std::sqrt(c * c + s * s + kTiny);
  Place next{c * scale, s * scale, 0.0F};
  next.share = ShareOn(shape, p, next.c, next.s);
  return next;
}

/// By the angle in which the ellipse beside the point, made a circle, sees it; the deeper inside,
/// the nearer to the quadrant's middle, from where steps lead past the medial axis.
[[gnu::always_inline]] inline Place Started(const InCircle& at, float share) {
  const float depth = 1.0F - std::sqrt(at.squared);
  const float inward = depth > 0.0F ? depth : 0.0F;
  const float c = at.u + (at.u < 0.0F ? -inward : inward);
  const float s = at.v + (at.v < 0.0F ? -inward : inward);
  const float scale = 1.0F / std::sqrt(c * c + s * s + kTiny);
  return {c * scale, s * scale, share};
}

[[gnu::always_inline]] inline Closest ClosestOnSide(const Shape& shape, const Vector& p, Place at) {
  for (int i = 0; i < kSteps; ++i) at = Stepped(shape, p, at);
  const float a = shape.a0 + at.share * shape.da, b = shape.b0 + at.share * shape.db;
  const float gx = shape.dx + shape.da * at.c, gy = shape.dy + shape.db * at.s;
  Closest closest{};
  closest.to_point = {p.x - shape.x0 - at.share * shape.dx - a * at.c,
                      p.y - shape.y0 - at.share * shape.dy - b * at.s,
                      p.z - at.share * shape.length};
  // Across the tangents around (-a s, b c, 0) and along (gx, gy, length).
  closest.normal = {b * at.c * shape.length, a * at.s * shape.length,
                    -(a * at.s * gy + b * at.c * gx)};
  const Vector& n = closest.normal;
  const float scale = 1.0F / std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z + kTiny);
  closest.normal = {n.x * scale, n.y * scale, n.z * scale};
  const Vector& t = closest.to_point;
  closest.squared = t.x * t.x + t.y * t.y + t.z * t.z;
  return closest;
}

[[gnu::always_inline]] inline void TakeDiscIfNearer(const Shape& shape, const Vector& p,
                                                    float share, float outward, Closest& closest) {
  const float height = p.z - share * shape.length;
  const bool is_nearer =
      (height * height < closest.squared) & (Normalised(shape, p, share).squared <= 1.0F);
  closest.squared = is_nearer ? height * height : closest.squared;
  closest.to_point.x = is_nearer ? 0.0F : closest.to_point.x;
  closest.to_point.y = is_nearer ? 0.0F : closest.to_point.y;
  closest.to_point.z = is_nearer ? height : closest.to_point.z;
  closest.normal.x = is_nearer ? 0.0F : closest.normal.x;
  closest.normal.y = is_nearer ? 0.0F : closest.normal.y;
  closest.normal.z = is_nearer ? outward : closest.normal.z;
}

// As parameters, since of local pointers GCC 12 does not believe __restrict.
[[gnu::always_inline]] inline void FindAll(const Shape& shape, int count, const float* __restrict x,
                                           const float* __restrict y, const float* __restrict z,
                                           float* __restrict distance, float* __restrict normal_x,
                                           float* __restrict normal_y, float* __restrict normal_z) {
  for (int i = 0; i < count; ++i) {
    const Vector p{x[i], y[i], z[i]};
    const float share = p.z * shape.per_length;
    const InCircle at = Normalised(shape, p, Clamped(share));
    Closest found = ClosestOnSide(shape, p, Started(at, Clamped(share)));
    TakeDiscIfNearer(shape, p, 0.0F, -1.0F, found);
    TakeDiscIfNearer(shape, p, 1.0F, 1.0F, found);
    const bool is_inside = (share >= 0.0F) & (share <= 1.0F) & (at.squared <= 1.0F);
    const float sign = is_inside ? -1.0F : 1.0F;
    distance[i] = sign * std::sqrt(found.squared);
    const float nx = sign * found.to_point.x + kOnSurface_m * found.normal.x;
    const float ny = sign * found.to_point.y + kOnSurface_m * found.normal.y;
    const float nz = sign * found.to_point.z + kOnSurface_m * found.normal.z;
    const float scale = 1.0F / std::sqrt(nx * nx + ny * ny + nz * nz + kTiny);
    normal_x[i] = nx * scale;
    normal_y[i] = ny * scale;
    normal_z[i] = nz * scale;
  }
}

}  // namespace

DEIXIS_KERNEL void FindClosestPoints(const DegenerateCylinder& cylinder, const PointArrays& points,
                                     const ClosestArrays& closest) {
  FindAll(ShapeOf(cylinder), points.count, points.x_m, points.y_m, points.z_m, closest.distance_m,
          closest.normal_x, closest.normal_y, closest.normal_z);
}

}  // namespace deixis::geometry
