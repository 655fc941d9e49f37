#pragma once
#include "common/geometry/degenerate_cylinder.h"

namespace deixis::pose_fitter {

/// One limb as the kernels see it: where it is, and its cylinder.
struct LimbSurface {
  float camera_from_limb[9];  ///< Rotation, row by row.
  float camera_in_limb_m[3];  ///< The camera's centre in the limb's frame.
  float a0_m, b0_m, a1_m, b1_m, length_m;
  float x0_m, y0_m, x1_m, y1_m;  ///< The ellipses' centres beside the bone.
};

/// Measured points, coordinate by coordinate, in the camera's optical frame.
struct RayPoints {
  const float* x_m;
  const float* y_m;
  const float* z_m;
  const float* sigma_z_m;
  int count;
};

/// How well a limb explains points, per point: the smallest is the limb's it belongs to.
struct RayScores {
  float* score2;  ///< Square of the smallest so far; replaced where this limb's is smaller.
  int* limb;      ///< Whose it is.
};

/// What the sums of one limb are made with.
struct SumSettings {
  float root_m[3];  ///< Moments are taken about it, in the camera's frame.
  float scale_m;    ///< Of the robust weight (Geman and McClure): (s^2 / (s^2 + r^2))^2.
  float across_m;   ///< Spread of a surface that is not noise along the ray, one sigma.
};

/// Sums over the points of one limb: of w v v' (21, lower triangle row by row), w r v (6), of
/// the robust cost r^2 / (s^2 + r^2), of w and of r^2, where v = ((p - root) x n, n), r the
/// distance by which the surface should move along its normal n at p.
struct LimbSums {
  static constexpr int kCount = 30;
  float values[kCount];
};

/// Scores points against one limb along their viewing rays: the difference in depth where the ray
/// meets the limb, in sigmas; where it passes by, the distance of the point, in units of
/// `across_m`. Only smaller scores replace those in `scores`.
void ScoreLimb(const LimbSurface& limb, int index, float across_m, const RayPoints& points,
               const RayScores& scores);

/// Adds the points' sums, all of them being of that limb.
void SumLimb(const LimbSurface& limb, const SumSettings& settings, const RayPoints& points,
             LimbSums& sums);

}  // namespace deixis::pose_fitter
