#include "services/anthropometer/core/solid.h"

#include <array>
#include <cmath>

namespace deixis::anthropometer {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Gauss-Legendre on 0..1 with four points: exact to the seventh power; the moments are of the
// fourth.
constexpr std::array<double, 4> kAt = {0.06943184420297371, 0.33000947820757187, 0.6699905217924281,
                                       0.9305681557970262};
constexpr std::array<double, 4> kWeight = {0.17392742256872692, 0.32607257743127307,
                                           0.32607257743127307, 0.17392742256872692};

}  // namespace

Solid SolidOf(const geometry::DegenerateCylinder& shape) {
  double volume = 0.0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();  // Integral of p p^T.
  for (std::size_t i = 0; i < kAt.size(); ++i) {
    const double s = kAt[i];
    const double a = shape.a0_m + s * (shape.a1_m - shape.a0_m);
    const double b = shape.b0_m + s * (shape.b1_m - shape.b0_m);
    const Eigen::Vector2d beside = shape.centre0_m + s * (shape.centre1_m - shape.centre0_m);
    const Vector3d centre(beside.x(), beside.y(), s * shape.length_m);
    const double slice = kWeight[i] * shape.length_m * M_PI * a * b;
    volume += slice;
    first += slice * centre;
    second += slice * (centre * centre.transpose());
    second.diagonal() += slice * Vector3d(0.25 * a * a, 0.25 * b * b, 0.0);
  }
  const Vector3d centre = first / volume;
  second -= volume * centre * centre.transpose();
  return {volume, centre, second.trace() * Matrix3d::Identity() - second};
}

double MeanRadius_m(const geometry::DegenerateCylinder& shape) {
  return std::sqrt(SolidOf(shape).volume_m3 / (M_PI * shape.length_m));
}

}  // namespace deixis::anthropometer
