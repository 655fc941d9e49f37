#include "services/pose_fitter/core/fitting/ray_kernels.h"

#include <cmath>

#include "common/kernels/kernel.h"

namespace deixis::pose_fitter {
namespace {

[[gnu::always_inline]] inline float Larger(float a, float b) { return a > b ? a : b; }
[[gnu::always_inline]] inline float Within(float value, float low, float high) {
  const float above = value > low ? value : low;
  return above < high ? above : high;
}

/// Where a viewing ray meets a limb, or where the limb is nearest to its point.
struct Meeting {
  float meets;       // 1 = the ray meets the surface, 0 = it passes by.
  float depth_m;     // Along the optical axis, when it meets.
  float distance_m;  // Of the point to the surface, roughly (never negative when it passes by).
  float nx, ny, nz;  // Outward normal there, in the limb's frame.
  float dx, dy, dz;  // The ray in the limb's frame, at z = 1.
};

/// A limb's ellipses by height: centre (x0 + kx h, y0 + ky h), semi-axes (a0 + ka h, b0 + kb h).
struct Slopes {
  float kx, ky, ka, kb;
};

[[gnu::always_inline]] inline Slopes SlopesOf(const LimbSurface& limb) {
  const float inverse_length = 1.0F / limb.length_m;
  return {(limb.x1_m - limb.x0_m) * inverse_length, (limb.y1_m - limb.y0_m) * inverse_length,
          (limb.a1_m - limb.a0_m) * inverse_length, (limb.b1_m - limb.b0_m) * inverse_length};
}

/// A ray in the coordinates of a tapered ellipse: (u0 + t u1, v0 + t v1) from its centre, whose
/// semi-axis along x is a0 + t a1.
struct Taper {
  float u0, u1, v0, v1, a0, a1;
};

[[gnu::always_inline]] inline Taper TaperOf(const LimbSurface& limb, const Slopes& k, float dx,
                                            float dy, float dz) {
  const float* o = limb.camera_in_limb_m;
  return {o[0] - limb.x0_m - k.kx * o[2], dx - k.kx * dz,
          o[1] - limb.y0_m - k.ky * o[2], dy - k.ky * dz,
          limb.a0_m + k.ka * o[2],        k.ka * dz};
}

struct Root {
  float t;
  float exists;  // 1 or 0.
};

/// Where a ray enters the quadric with the ratio a / b of semi-axes. By the root's other form,
/// which holds too where the limb tapers faster than the ray nears its axis (qa <= 0).
[[gnu::always_inline]] inline Root FrontRoot(const Taper& p, float a, float b) {
  const float a2 = a * a, b2 = b * b;
  const float qa = b2 * (p.u1 * p.u1 - p.a1 * p.a1) + a2 * p.v1 * p.v1;
  const float qb = b2 * (p.u0 * p.u1 - p.a0 * p.a1) + a2 * p.v0 * p.v1;
  const float qc = b2 * (p.u0 * p.u0 - p.a0 * p.a0) + a2 * p.v0 * p.v0;
  const float d = qb * qb - qa * qc;
  const float below = std::sqrt(Larger(d, 0.0F)) - qb;
  const float exists = ((d > 0.0F) & (below > 0.0F)) ? 1.0F : 0.0F;
  return {qc / Larger(below, 1e-20F), exists};
}

/// Rays through side or discs: b^2 (U0 + t U1)^2 + a^2 (V0 + t V1)^2 = b^2 (A0 + t A1)^2 with a / b
/// at the height of the meeting: first that of the point, then that of where it is met by that.
[[gnu::always_inline]] inline Meeting Meet(const LimbSurface& limb, float x, float y, float z) {
  const float* r = limb.camera_from_limb;
  const float* o = limb.camera_in_limb_m;
  const float inverse_z = 1.0F / z;
  const float rx = x * inverse_z, ry = y * inverse_z;
  Meeting m;
  m.dx = r[0] * rx + r[3] * ry + r[6];
  m.dy = r[1] * rx + r[4] * ry + r[7];
  m.dz = r[2] * rx + r[5] * ry + r[8];
  const Slopes slopes = SlopesOf(limb);
  const float kx = slopes.kx, ky = slopes.ky, ka = slopes.ka, kb = slopes.kb;
  const Taper taper = TaperOf(limb, slopes, m.dx, m.dy, m.dz);
  const float u0 = taper.u0, u1 = taper.u1, v0 = taper.v0, v1 = taper.v1;
  Root root{z, 0.0F};
  for (int round = 0; round < 3; ++round) {
    const float at = Within(o[2] + root.t * m.dz, 0.0F, limb.length_m);
    root = FrontRoot(taper, limb.a0_m + ka * at, limb.b0_m + kb * at);
  }
  const float t = root.t;
  // The disc that faces the camera, when the side is met beyond it.
  const float height = o[2] + t * m.dz;
  const bool before = height<0.0F, beyond = height> limb.length_m;
  // Not chosen by a condition: loads under one would keep the loop from vectors.
  const float end = (beyond ? 1.0F : 0.0F) * limb.length_m;
  const float safe_dz = std::abs(m.dz) < 1e-6F ? 1e-6F : m.dz;
  const float td = (end - o[2]) / safe_dz;
  const float ea = limb.a0_m + ka * end, eb = limb.b0_m + kb * end;
  const float du = (u0 + td * u1) / ea, dv = (v0 + td * v1) / eb;
  const float outwards = beyond ? 1.0F : -1.0F;
  const bool faces = outwards * m.dz < 0.0F;
  const bool on_disc = (before | beyond) & faces & (du * du + dv * dv <= 1.0F);
  const float beside_ends = (before | beyond) ? 0.0F : root.exists;
  m.meets = on_disc ? 1.0F : beside_ends;
  m.depth_m = on_disc ? td : t;
  // Where it passes by: the point itself, against the ellipse at its height.
  const float pz = o[2] + z * m.dz;
  const float s = Within(pz, 0.0F, limb.length_m);
  // Blended, not chosen: jumps from condition to condition would keep the loop from vectors.
  const float at = z + m.meets * (m.depth_m - z);
  const float h = Within(o[2] + at * m.dz, 0.0F, limb.length_m);
  const float a = limb.a0_m + ka * h, b = limb.b0_m + kb * h;
  const float u = o[0] + at * m.dx - limb.x0_m - kx * h;
  const float v = o[1] + at * m.dy - limb.y0_m - ky * h;
  const float ua = u / a, vb = v / b;
  const float norm = std::sqrt(ua * ua + vb * vb) + 1e-9F;
  const float outward = std::sqrt(u * u + v * v);
  const float beside = Larger(outward - outward / norm, 0.0F);
  const float axial = pz - s;
  const float distance = std::sqrt(beside * beside + axial * axial);
  m.distance_m = distance;
  // Side normal at height h: gradient of the implicit ellipse, with its taper and slant.
  float gx = ua / a, gy = vb / b;
  const float unit = 1.0F / norm;
  float gz = -(gx * kx + gy * ky) - (ua * ua * ka / a + vb * vb * kb / b);
  gx *= unit, gy *= unit, gz *= unit;
  // Beyond the ends of a limb that is passed by: away from its rim.
  const float ring = std::sqrt(gx * gx + gy * gy) + 1e-9F;
  const float inverse_distance = 1.0F / (distance + 1e-6F);
  const float rim_x = beside * inverse_distance * gx / ring;
  const float rim_y = beside * inverse_distance * gy / ring;
  const float rim_z = axial * inverse_distance;
  const float past = (1.0F - m.meets) * std::abs(axial);
  const bool rim = past > 1e-6F;
  gx = on_disc ? 0.0F : (rim ? rim_x : gx);
  gy = on_disc ? 0.0F : (rim ? rim_y : gy);
  gz = on_disc ? outwards : (rim ? rim_z : gz);
  const float inverse = 1.0F / (std::sqrt(gx * gx + gy * gy + gz * gz) + 1e-9F);
  m.nx = gx * inverse;
  m.ny = gy * inverse;
  m.nz = gz * inverse;
  return m;
}

/// The square of a point's score: as Meet has it, with one look less at the taper.
[[gnu::always_inline]] inline float Score2(const LimbSurface& limb, float inverse_across2, float x,
                                           float y, float z, float sigma) {
  const float* r = limb.camera_from_limb;
  const float* o = limb.camera_in_limb_m;
  const float inverse_z = 1.0F / z;
  const float rx = x * inverse_z, ry = y * inverse_z;
  const float dx = r[0] * rx + r[3] * ry + r[6];
  const float dy = r[1] * rx + r[4] * ry + r[7];
  const float dz = r[2] * rx + r[5] * ry + r[8];
  const Slopes k = SlopesOf(limb);
  const Taper p = TaperOf(limb, k, dx, dy, dz);
  const float point_height = o[2] + z * dz;
  const float h = Within(point_height, 0.0F, limb.length_m);
  const float a = limb.a0_m + k.ka * h, b = limb.b0_m + k.kb * h;
  Root root = FrontRoot(p, a, b);
  const float h1 = Within(o[2] + root.t * dz, 0.0F, limb.length_m);
  root = FrontRoot(p, limb.a0_m + k.ka * h1, limb.b0_m + k.kb * h1);
  const float height = o[2] + root.t * dz;
  const bool before = height<0.0F, beyond = height> limb.length_m;
  // The disc that faces the camera, when the side is met beyond it. Blended, not chosen: loads
  // under a condition would keep the loop from vectors.
  const float end = (beyond ? 1.0F : 0.0F) * limb.length_m;
  const float safe_dz = std::abs(dz) < 1e-6F ? 1e-6F : dz;
  const float td = (end - o[2]) / safe_dz;
  const float ea = limb.a0_m + k.ka * end, eb = limb.b0_m + k.kb * end;
  const float du = (p.u0 + td * p.u1) * eb, dv = (p.v0 + td * p.v1) * ea;
  const bool faces = (beyond ? dz : -dz) < 0.0F;
  const bool on_disc = (before | beyond) & faces & (du * du + dv * dv <= ea * ea * eb * eb);
  const float beside_ends = (before | beyond) ? 0.0F : root.exists;
  const float meets = on_disc ? 1.0F : beside_ends;
  const float along = (z - (on_disc ? td : root.t)) / sigma;
  // Where it passes by: the point itself, against the ellipse at its height.
  const float u = o[0] + z * dx - limb.x0_m - k.kx * h;
  const float v = o[1] + z * dy - limb.y0_m - k.ky * h;
  const float ub = u * b, va = v * a;
  const float out = Larger(1.0F - a * b / std::sqrt(ub * ub + va * va + 1e-20F), 0.0F);
  const float axial = point_height - h;
  const float beside2 = ((u * u + v * v) * (out * out) + axial * axial) * inverse_across2;
  return meets > 0.5F ? along * along : beside2;
}

[[gnu::always_inline]] inline void Score(const LimbSurface& limb, int index, float across_m,
                                         const float* __restrict x, const float* __restrict y,
                                         const float* __restrict z, const float* __restrict sigma,
                                         int count, float* __restrict score2,
                                         int* __restrict winner) {
  const float inverse_across2 = 1.0F / (across_m * across_m);
  for (int i = 0; i < count; ++i) {
    const float mine2 = Score2(limb, inverse_across2, x[i], y[i], z[i], sigma[i]);
    const bool better = mine2 < score2[i];
    score2[i] = better ? mine2 : score2[i];
    winner[i] = better ? index : winner[i];
  }
}

[[gnu::always_inline]] inline void Sum(const LimbSurface& limb, const SumSettings& settings,
                                       const float* __restrict x, const float* __restrict y,
                                       const float* __restrict z, const float* __restrict sigma,
                                       int count, float* __restrict out) {
  const float* r = limb.camera_from_limb;
  const float scale2 = settings.scale_m * settings.scale_m;
  const float across2 = settings.across_m * settings.across_m;
  const float cx = settings.root_m[0], cy = settings.root_m[1], cz = settings.root_m[2];
  float s0 = 0, s1 = 0, s2 = 0, s3 = 0, s4 = 0, s5 = 0, s6 = 0, s7 = 0, s8 = 0, s9 = 0, s10 = 0,
        s11 = 0, s12 = 0, s13 = 0, s14 = 0, s15 = 0, s16 = 0, s17 = 0, s18 = 0, s19 = 0, s20 = 0,
        s21 = 0, s22 = 0, s23 = 0, s24 = 0, s25 = 0, s26 = 0, s27 = 0, s28 = 0, s29 = 0;
  for (int i = 0; i < count; ++i) {
    const Meeting m = Meet(limb, x[i], y[i], z[i]);
    const bool met = m.meets > 0.5F;
    const float nx = r[0] * m.nx + r[1] * m.ny + r[2] * m.nz;
    const float ny = r[3] * m.nx + r[4] * m.ny + r[5] * m.nz;
    const float nz = r[6] * m.nx + r[7] * m.ny + r[8] * m.nz;
    const float inverse_z = 1.0F / z[i];
    // How much of a step in depth goes along the normal.
    const float share = nx * x[i] * inverse_z + ny * y[i] * inverse_z + nz;
    const float residual = met ? (z[i] - m.depth_m) * share : m.distance_m;
    const float variance = share * share * sigma[i] * sigma[i] + across2;
    const float robust = scale2 / (scale2 + residual * residual);
    const float w = robust * robust / variance;
    const float ratio = m.depth_m * inverse_z;
    const float px = (met ? x[i] * ratio : x[i] - residual * nx) - cx;
    const float py = (met ? y[i] * ratio : y[i] - residual * ny) - cy;
    const float pz = (met ? m.depth_m : z[i] - residual * nz) - cz;
    const float v0 = py * nz - pz * ny, v1 = pz * nx - px * nz, v2 = px * ny - py * nx;
    const float w0 = w * v0, w1 = w * v1, w2 = w * v2, w3 = w * nx, w4 = w * ny, w5 = w * nz;
    s0 += w0 * v0;
    s1 += w1 * v0, s2 += w1 * v1;
    s3 += w2 * v0, s4 += w2 * v1, s5 += w2 * v2;
    s6 += w3 * v0, s7 += w3 * v1, s8 += w3 * v2, s9 += w3 * nx;
    s10 += w4 * v0, s11 += w4 * v1, s12 += w4 * v2, s13 += w4 * nx, s14 += w4 * ny;
    s15 += w5 * v0, s16 += w5 * v1, s17 += w5 * v2, s18 += w5 * nx, s19 += w5 * ny, s20 += w5 * nz;
    s21 += w0 * residual, s22 += w1 * residual, s23 += w2 * residual;
    s24 += w3 * residual, s25 += w4 * residual, s26 += w5 * residual;
    s27 += 1.0F - robust, s28 += w, s29 += residual * residual;
  }
  const float sums[LimbSums::kCount] = {s0,  s1,  s2,  s3,  s4,  s5,  s6,  s7,  s8,  s9,
                                        s10, s11, s12, s13, s14, s15, s16, s17, s18, s19,
                                        s20, s21, s22, s23, s24, s25, s26, s27, s28, s29};
  for (int i = 0; i < LimbSums::kCount; ++i) out[i] += sums[i];
}

}  // namespace

DEIXIS_KERNEL
void ScoreLimb(const LimbSurface& limb, int index, float across_m, const RayPoints& points,
               const RayScores& scores) {
  Score(limb, index, across_m, points.x_m, points.y_m, points.z_m, points.sigma_z_m, points.count,
        scores.score2, scores.limb);
}

DEIXIS_KERNEL
void SumLimb(const LimbSurface& limb, const SumSettings& settings, const RayPoints& points,
             LimbSums& sums) {
  Sum(limb, settings, points.x_m, points.y_m, points.z_m, points.sigma_z_m, points.count,
      sums.values);
}

}  // namespace deixis::pose_fitter
