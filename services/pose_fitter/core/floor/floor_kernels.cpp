#include "services/pose_fitter/core/floor/floor_kernels.h"

#include <algorithm>
#include <cmath>

#include "common/kernels/kernel.h"

namespace deixis::pose_fitter {
namespace {

constexpr float kRoughness_m = 0.006F;  // One sigma of what a floor is no plane by.

/// What a distance from the plane is in inverse depth: distance = height z error.
[[gnu::always_inline]] inline float InverseOf(float distance_m, float inverse_z,
                                              const InversePlane& plane) {
  return distance_m * inverse_z / plane.height_m;
}

[[gnu::always_inline]] inline float ErrorOf(const FloorSamples& samples, const InversePlane& plane,
                                            int i) {
  return samples.inverse_z[i] -
         (plane.slope_x * samples.ray_x[i] + plane.slope_y * samples.ray_y[i] + plane.fixed);
}

[[gnu::always_inline]] inline float ToleranceOf(const FloorSamples& samples,
                                                const InversePlane& plane,
                                                const FloorTolerance& tolerance, int i) {
  return tolerance.sigmas * samples.sigma[i] +
         InverseOf(tolerance.distance_m, samples.inverse_z[i], plane);
}

}  // namespace

DEIXIS_KERNEL FloorSupport SupportOf(const FloorSamples& samples, const InversePlane& plane,
                                     const FloorTolerance& tolerance) {
  float on = 0.0F;
  float below = 0.0F;
  for (int i = 0; i < samples.count; ++i) {
    const float error = ErrorOf(samples, plane, i);
    const float near = ToleranceOf(samples, plane, tolerance, i);
    // What lies below is seen through the plane and counts as that part of it.
    const float nearest = std::max(samples.inverse_z[i], samples.inverse_z[i] - error);
    const float area = 1.0F / (nearest * nearest);
    on += std::abs(error) < near ? area : 0.0F;
    below += error < -near ? area : 0.0F;
  }
  return {on, below};
}

DEIXIS_KERNEL FloorEquations EquationsOf(const FloorSamples& samples, const InversePlane& plane,
                                         const FloorTolerance& tolerance) {
  FloorEquations sum;
  float xx = 0.0F, xy = 0.0F, sx = 0.0F, yy = 0.0F, sy = 0.0F, one = 0.0F;
  float xq = 0.0F, yq = 0.0F, sq = 0.0F, count = 0.0F;
  for (int i = 0; i < samples.count; ++i) {
    const float is_on =
        std::abs(ErrorOf(samples, plane, i)) < ToleranceOf(samples, plane, tolerance, i) ? 1.0F
                                                                                         : 0.0F;
    const float rough = InverseOf(kRoughness_m, samples.inverse_z[i], plane);
    const float weight = is_on / (samples.sigma[i] * samples.sigma[i] + rough * rough);
    const float x = samples.ray_x[i];
    const float y = samples.ray_y[i];
    const float q = samples.inverse_z[i];
    xx += weight * x * x;
    xy += weight * x * y;
    sx += weight * x;
    yy += weight * y * y;
    sy += weight * y;
    one += weight;
    xq += weight * x * q;
    yq += weight * y * q;
    sq += weight * q;
    count += is_on;
  }
  sum = {xx, xy, sx, yy, sy, one, xq, yq, sq, count};
  return sum;
}

}  // namespace deixis::pose_fitter
