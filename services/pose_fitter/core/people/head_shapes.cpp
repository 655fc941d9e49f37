#include "services/pose_fitter/core/people/head_shapes.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;
using Eigen::Vector3d;

constexpr int kColumns = 160;                         // Of the grid of middles that are tried.
constexpr float kLeast_px = 3;                        // Radius of a head that can be told.
constexpr int kOuter = 13;                            // Samples of the arc about a head,
constexpr int kRing = 8;                              // of either ring within it.
constexpr double kLowest_rad = -0.5;                  // Where the arc ends, below the middle.
constexpr double kInnerRing = 0.4, kOuterRing = 0.8;  // Of the radius.
constexpr double kLeastBulge = 0.5;                   // Of what a ball bulges by there.
constexpr float kBulgeNoise = 0.2F, kFlat = 0.1F;
constexpr int kLeastTrunk = 3;  // Samples below a head that are in the image.
constexpr double kNoise = 2.5;
constexpr std::size_t kMostCandidates = 4096;  // Of places next to each other, most of them.

Vector2f OnCircle(double radius_m, double angle_rad) {
  return Vector2d(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad)).cast<float>();
}

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
  // From the sides on: there most places are no head.
  for (int i = 0; i < kOuter; ++i) {
    const int step = i % 2 == 0 ? i / 2 : kOuter - 1 - i / 2;
    const double angle = kLowest_rad + (M_PI - 2.0 * kLowest_rad) * step / (kOuter - 1);
    outer_m_.push_back(OnCircle(config_.clear_m, angle));
  }
  for (const double share : {kInnerRing, kOuterRing}) {
    for (int i = 0; i < kRing; ++i) {
      inner_m_.push_back(OnCircle(share * config_.radius_m, 2.0 * M_PI * i / kRing));
    }
  }
  for (const double side : {-1.0, 0.0, 1.0}) {
    for (const double lower : {1.0, 1.3}) {
      trunk_m_.push_back(
          Vector2d(side * config_.shoulders_m, -lower * config_.shoulders_below_m).cast<float>());
    }
  }
  candidates_.reserve(kMostCandidates);
  heads_.reserve(static_cast<std::size_t>(config_.most));
}

/// Depths about a pixel.
struct HeadShapes::Probe {
  const DepthView* depth;
  Vector2f at_px, right_px, up_px;  ///< The last two per metre at that distance.
  float z_m, noise_m;               ///< Of the pixel; noise that no difference is due to.

  /// Metres, 0 = not measured, -1 = beside the image. `offset_m`: to the right and up.
  float At(const Vector2f& offset_m) const {
    const Vector2f px = at_px + offset_m.x() * right_px + offset_m.y() * up_px;
    const auto u = static_cast<int>(px.x() + 0.5F), v = static_cast<int>(px.y() + 0.5F);
    const bool is_beside =
        px.x() < 0.0F || px.y() < 0.0F || u >= depth->width_px() || v >= depth->height_px();
    return is_beside ? -1.0F : depth->z_m(u, v);
  }
};

/// Of the arc above and beside a head, what is none of it.
float HeadShapes::ClearShare(const Probe& probe) const {
  const auto behind_m = static_cast<float>(config_.behind_m);
  const auto least = static_cast<float>(config_.least_share);
  int clear = 0, judged = 0, left = kOuter;
  for (const Vector2f& offset_m : outer_m_) {
    const float there_m = probe.At(offset_m);
    --left;
    if (there_m > 0.0F && there_m < probe.z_m - behind_m) continue;  // It may hide what is there.
    ++judged;
    clear += there_m == 0.0F || there_m > probe.z_m + behind_m + probe.noise_m ? 1 : 0;
    if (static_cast<float>(clear + left) < least * static_cast<float>(judged + left)) return 0.0F;
  }
  return 2 * judged < kOuter ? 0.0F : static_cast<float>(clear) / static_cast<float>(judged);
}

/// Of the disc of a head, what is as far as its middle.
float HeadShapes::HeadShare(const Probe& probe) const {
  const float same_m = static_cast<float>(config_.same_m) + probe.noise_m;
  int same = 0;
  for (const Vector2f& offset_m : inner_m_) {
    const float there_m = probe.At(offset_m);
    same += there_m > 0.0F && std::abs(there_m - probe.z_m) < same_m ? 1 : 0;
  }
  const float share = static_cast<float>(same) / static_cast<float>(inner_m_.size());
  return share < static_cast<float>(config_.least_share) ? 0.0F : share;
}

/// How much its rows bulge as those of a head do, at least: boards and boxes have flat ones.
float HeadShapes::Roundness(const Probe& probe) const {
  const auto side_m = static_cast<float>(kOuterRing * config_.radius_m);
  const float same_m = static_cast<float>(config_.same_m) + probe.noise_m;
  float bulge_m = 0.0F;
  int rows = 0;
  for (const float share : {-0.3F, 0.0F, 0.3F}) {
    const float up_m = share * static_cast<float>(config_.radius_m);
    const float middle_m = probe.At({0.0F, up_m});
    const float left_m = probe.At({-side_m, up_m}), right_m = probe.At({side_m, up_m});
    const float row_m = 0.5F * (left_m + right_m) - middle_m;
    if (middle_m <= 0.0F || left_m <= 0.0F || right_m <= 0.0F || row_m > same_m) continue;
    bulge_m += row_m;
    ++rows;
  }
  if (rows == 0) return kFlat;
  const double ball_m = config_.radius_m * (1.0 - std::sqrt(1.0 - kOuterRing * kOuterRing));
  const float bulges = (bulge_m / static_cast<float>(rows) + kBulgeNoise * probe.noise_m) /
                       static_cast<float>(kLeastBulge * ball_m);
  return std::clamp(bulges, kFlat, 1.0F);
}

/// Of where the trunk should be, what is about as far as the head.
float HeadShapes::TrunkShare(const Probe& probe) const {
  int trunk = 0, seen = 0;
  for (const Vector2f& offset_m : trunk_m_) {
    const float there_m = probe.At(offset_m);
    if (there_m < 0.0F) continue;
    ++seen;
    trunk += there_m > 0.0F && std::abs(there_m - probe.z_m) <
                                   static_cast<float>(config_.trunk_m) + probe.noise_m
                 ? 1
                 : 0;
  }
  const float share = static_cast<float>(trunk) / static_cast<float>(std::max(1, seen));
  return seen < kLeastTrunk || share < static_cast<float>(config_.least_share) ? 0.0F : share;
}

double HeadShapes::LikenessAt(const DepthView& depth, int u, int v, const Vector2d& up_px) const {
  const float z_m = depth.z_m(u, v);
  const auto px_per_m = static_cast<float>(depth.camera().focal_px.x()) / z_m;
  if (static_cast<float>(config_.radius_m) * px_per_m < kLeast_px) return 0.0;
  const Vector2f up = px_per_m * up_px.cast<float>();
  const double noise_m = kNoise * depth.camera().noise.Sigma_m(static_cast<double>(z_m));
  const Probe probe{&depth,
                    Vector2f(static_cast<float>(u), static_cast<float>(v)),
                    Vector2f(-up.y(), up.x()),
                    up,
                    z_m,
                    static_cast<float>(noise_m)};
  float likeness = ClearShare(probe);
  if (likeness > 0.0F) likeness *= HeadShare(probe);
  if (likeness > 0.0F) likeness *= TrunkShare(probe);
  if (likeness > 0.0F) likeness *= Roundness(probe);
  return static_cast<double>(likeness);
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
