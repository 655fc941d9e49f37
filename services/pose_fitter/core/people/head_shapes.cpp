#include "services/pose_fitter/core/people/head_shapes.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kColumns = 160;    // Of the grid of middles that are tried.
constexpr double kLeast_px = 3;  // Radius of a head that can be told.
constexpr int kInner = 8, kOuter = 13;
constexpr double kLowest_rad = -0.5;  // Of the arc about a head that is looked at.
constexpr double kNoise = 2.5;
constexpr std::size_t kMostCandidates = 4096;  // Of places next to each other, most of them.

}  // namespace

void HeadShapesConfig::Validate() const {
  config::Faults faults;
  for (const auto& [value, key] : {std::pair(radius_m, "radius_m"),
                                   {clear_m, "clear_m"},
                                   {behind_m, "behind_m"},
                                   {same_m, "same_m"},
                                   {shoulders_below_m, "shoulders_below_m"},
                                   {shoulders_m, "shoulders_m"},
                                   {trunk_m, "trunk_m"},
                                   {apart_m, "apart_m"}}) {
    faults.Require(value > 0.0, key, "must be positive");
  }
  faults.Require(least_share >= 0.0 && least_share <= 1.0, "least_share", "must be 0..1");
  faults.Require(most >= 1 && most <= 100, "most", "must be 1..100");
  faults.ThrowIfAny();
}

HeadShapes::HeadShapes(const HeadShapesConfig& config) : config_(config) {
  config_.Validate();
  candidates_.reserve(kMostCandidates);
  heads_.reserve(static_cast<std::size_t>(config_.most));
}

/// Depths about a pixel.
struct HeadShapes::Probe {
  const DepthView* depth;
  Vector2d at_px, right_px, up_px;  ///< The last two per metre at that distance.

  /// Metres, 0 = not measured, -1 = beside the image.
  double At(double right_m, double up_m) const {
    const Vector2d px = at_px + right_m * right_px + up_m * up_px;
    const auto u = static_cast<int>(std::lround(px.x())), v = static_cast<int>(std::lround(px.y()));
    if (u < 0 || v < 0 || u >= depth->width_px() || v >= depth->height_px()) return -1.0;
    return static_cast<double>(depth->z_m(u, v));
  }
};

/// Of the arc above and beside a head, what is none of it. From the sides on: most places fail
/// there.
double HeadShapes::ClearShare(const Probe& probe, double z_m, double noise_m) const {
  int clear = 0, judged = 0, left = kOuter;
  for (int i = 0; i < kOuter; ++i, --left) {
    const int from_end = i / 2;
    const int step = i % 2 == 0 ? from_end : kOuter - 1 - from_end;
    const double angle = kLowest_rad + (M_PI - 2.0 * kLowest_rad) * step / (kOuter - 1);
    const double there_m =
        probe.At(config_.clear_m * std::cos(angle), config_.clear_m * std::sin(angle));
    if (there_m > 0.0 && there_m < z_m - config_.behind_m) continue;  // It may hide what is there.
    ++judged;
    clear += there_m == 0.0 || there_m > z_m + config_.behind_m + noise_m ? 1 : 0;
    if (clear + left - 1 < config_.least_share * (judged + left - 1)) return 0.0;
  }
  return 2 * judged < kOuter ? 0.0 : static_cast<double>(clear) / judged;
}

double HeadShapes::LikenessAt(const DepthView& depth, int u, int v, const Vector2d& up_px) const {
  const auto z = static_cast<double>(depth.z_m(u, v));
  const double px_per_m = depth.camera().focal_px.x() / z;
  if (config_.radius_m * px_per_m < kLeast_px) return 0.0;
  const double noise_m = kNoise * depth.camera().noise.Sigma_m(z);
  const Probe probe{&depth, Vector2d(u, v), px_per_m * Vector2d(-up_px.y(), up_px.x()),
                    px_per_m * up_px};
  const double clear = ClearShare(probe, z, noise_m);
  if (clear < config_.least_share) return 0.0;
  double same = 0.0, bulge_m = 0.0;
  int measured = 0;
  for (int i = 0; i < 2 * kInner; ++i) {
    const double angle = 2.0 * M_PI * i / kInner;
    const double radius_m = (i < kInner ? 0.4 : 0.8) * config_.radius_m;
    const double there_m = probe.At(radius_m * std::cos(angle), radius_m * std::sin(angle));
    if (there_m <= 0.0) continue;
    const bool is_same = std::abs(there_m - z) < config_.same_m + noise_m;
    same += is_same ? 1.0 : 0.0;
    if (!is_same || i < kInner) continue;
    bulge_m += there_m - z;
    ++measured;
  }
  same /= 2 * kInner;
  if (same < config_.least_share || measured == 0) return 0.0;
  bulge_m /= measured;
  double trunk = 0.0;
  int seen = 0;
  for (const double side : {-1.0, 0.0, 1.0}) {
    for (const double lower : {1.0, 1.3}) {
      const double there_m =
          probe.At(side * config_.shoulders_m, -lower * config_.shoulders_below_m);
      if (there_m < 0.0) continue;
      ++seen;
      trunk += there_m > 0.0 && std::abs(there_m - z) < config_.trunk_m + noise_m ? 1.0 : 0.0;
    }
  }
  if (seen < 3 || trunk < config_.least_share * seen) return 0.0;
  // A ball of that radius bulges by so much there.
  const double ball_m = config_.radius_m * (1.0 - std::sqrt(1.0 - 0.8 * 0.8));
  const double round = std::clamp((bulge_m + 0.4 * noise_m) / (0.5 * ball_m), 0.1, 1.0);
  return clear * same * (trunk / seen) * round;
}

const std::vector<HeadShape>& HeadShapes::Find(const DepthView& depth,
                                               const std::vector<std::uint8_t>& is_sound,
                                               const Vector3d& up, double near_m, double far_m) {
  candidates_.clear();
  heads_.clear();
  const DepthCamera& camera = depth.camera();
  const int step = std::max(1, camera.width_px / kColumns);
  const Vector2d up_px = up.head<2>().normalized();
  for (int v = 0; v < camera.height_px; v += step) {
    for (int u = 0; u < camera.width_px; u += step) {
      const auto z = static_cast<double>(depth.z_m(u, v));
      if (z < near_m || z > far_m ||
          is_sound[static_cast<std::size_t>(v * camera.width_px + u)] == 0) {
        continue;
      }
      const double likeness = LikenessAt(depth, u, v, up_px);
      if (likeness <= 0.0 || candidates_.size() == kMostCandidates) continue;
      const Vector3d middle_m = depth.Point(u, v);
      candidates_.push_back({u, v, middle_m, middle_m + 1.2 * config_.radius_m * up, likeness});
    }
  }
  std::sort(candidates_.begin(), candidates_.end(), [](const HeadShape& a, const HeadShape& b) {
    return std::tuple(-a.likeness, a.v_px, a.u_px) < std::tuple(-b.likeness, b.v_px, b.u_px);
  });
  for (const HeadShape& candidate : candidates_) {
    if (static_cast<int>(heads_.size()) == config_.most) break;
    const bool is_taken = std::any_of(heads_.begin(), heads_.end(), [&](const HeadShape& head) {
      return (head.middle_m - candidate.middle_m).norm() < config_.apart_m;
    });
    if (!is_taken) heads_.push_back(candidate);
  }
  return heads_;
}

}  // namespace deixis::pose_fitter
