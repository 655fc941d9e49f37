#include "services/pose_fitter/core/floor/floor_tracker.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "common/filtering/random.h"
#include "services/pose_fitter/core/depth/sound_depth.h"

namespace deixis::pose_fitter {
namespace {

constexpr int kColumns = 80;      // Of the sampled grid.
constexpr int kDraws = 1200;      // Of three samples; most are no floor at all,
constexpr int kHypotheses = 200;  // so many that may be one are weighed.
constexpr int kFinalists = 6;
constexpr int kRefinements = 3;
constexpr std::uint64_t kSeed = 0x5EA2C4F1002;
constexpr int kSmooth_px = 2;
constexpr double kSmoothSigmas = 2.0;
constexpr double kSmoothSlope = 2.0;
constexpr int kAttempts = 8;
constexpr double kLeastSpread = 1e-5;  // Of three rays, else they lie in a line.
constexpr double kBetter = 1.1;        // Score of a plane that replaces the one followed.
constexpr double kBelowPenalty = 4.0;
constexpr int kLeastSamples = 40;
constexpr double kSameTilt_rad = 0.008;  // Beyond these the camera has moved.
constexpr double kSameHeight_m = 0.015;
constexpr FloorTolerance kSearchTolerance = {2.5F, 0.03F};
constexpr FloorTolerance kTrackTolerance = {3.0F, 0.06F};
constexpr FloorTolerance kFineTolerance = {1.5F, 0.01F};
constexpr FloorTolerance kCloseTolerance = {1.0F, 0.008F};
constexpr float kClose = 0.38F;  // Of what is on a plane lies so close to it; of what only passes
                                 // through it, about a third.
constexpr float kLargeClose = 0.33F;  // A large one may be rough, or its depth be bad.
constexpr double kLarge_m2 = 0.6;     // Seen head on.

double Radians(double degrees) { return degrees * M_PI / 180.0; }

InversePlane PlaneOf(const Eigen::Vector3d& slopes) {
  return {static_cast<float>(slopes.x()), static_cast<float>(slopes.y()),
          static_cast<float>(slopes.z()), static_cast<float>(1.0 / slopes.norm())};
}

body_model::Floor FloorOf(const Eigen::Vector3d& slopes) {
  const double height_m = 1.0 / slopes.norm();
  return {-slopes * height_m, height_m};
}

Eigen::Vector3d SlopesOf(const body_model::Floor& floor) { return -floor.normal / floor.offset_m; }

double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

void FloorTrackerConfig::Validate() const {
  config::Faults faults;
  faults.Require(largest_roll_deg > 0.0 && largest_roll_deg < 80.0, "largest_roll_deg",
                 "must lie between 0 and 80");
  faults.Require(largest_pitch_deg > 0.0 && largest_pitch_deg < 80.0, "largest_pitch_deg",
                 "must lie between 0 and 80");
  faults.Require(lowest_camera_m > 0.0, "lowest_camera_m", "must be positive");
  faults.Require(highest_camera_m > lowest_camera_m, "highest_camera_m",
                 "must be larger than lowest_camera_m");
  faults.Require(farthest_m > 0.0, "farthest_m", "must be positive");
  faults.Require(least_area_m2 > 0.0, "least_area_m2", "must be positive");
  faults.Require(hold_time_s >= 0.0, "hold_time_s", "must not be negative");
  faults.Require(search_time_s >= 0.0, "search_time_s", "must not be negative");
  faults.Require(smooth_time_s > 0.0, "smooth_time_s", "must be positive");
  faults.Require(known_tilt_deg > 0.0, "known_tilt_deg", "must be positive");
  faults.Require(known_height_m > 0.0, "known_height_m", "must be positive");
  faults.ThrowIfAny();
}

FloorTracker::FloorTracker(const FloorTrackerConfig& config) : config_(config) {
  config_.Validate();
}

void FloorTracker::Reset() {
  slopes_.reset();
  floor_.reset();
  has_time_ = false;
}

const std::optional<body_model::Floor>& FloorTracker::Update(
    const DepthView& depth, const std::vector<std::uint8_t>& is_sound, double time_s,
    const std::optional<body_model::Floor>& known) {
  if (has_time_ && time_s < time_s_) Reset();
  const double elapsed_s = has_time_ ? time_s - time_s_ : 0.0;
  known_ = known;
  TakeSamples(depth, is_sound);
  Equations equations;
  auto seen = slopes_ ? Refined(*slopes_, equations) : std::nullopt;
  if (!seen || !has_time_ || time_s - search_time_s_ >= config_.search_time_s) {
    search_time_s_ = time_s;
    TakeBetter(seen, equations);
  }
  if (seen) {
    Remember(*seen, equations, elapsed_s);
    seen_time_s_ = time_s;
  } else if (slopes_ && time_s - seen_time_s_ > config_.hold_time_s) {
    slopes_.reset();
  }
  floor_ = slopes_ ? std::optional(FloorOf(*slopes_)) : known_;
  time_s_ = time_s;
  has_time_ = true;
  return floor_;
}

/// Searches without regard to what is known, and takes what is clearly better.
void FloorTracker::TakeBetter(std::optional<Slopes>& seen, Equations& equations) const {
  Equations others;
  auto found = Search();
  if (found) found = Refined(*found, others);
  if (!found || (seen && Score(*found) <= kBetter * std::max(0.0, Score(*seen)))) return;
  seen = found;
  equations = others;
}

FloorSamples FloorTracker::samples() const {
  return {ray_x_.data(), ray_y_.data(), inverse_z_.data(), sigma_.data(),
          static_cast<int>(ray_x_.size())};
}

namespace {

/// Whether what lies around a pixel goes on as a plane does: stereo without texture does not.
bool IsSmooth(const DepthView& depth, int u, int v, const StepLimit& limit) {
  const int d = kSmooth_px;
  if (u < d || v < d || u >= depth.width_px() - d || v >= depth.height_px() - d) return false;
  const float z = depth.z_m(u, v);
  const float most = limit.fixed_m + z * (limit.per_m + z * limit.per_square_m);
  const auto bends = [&](float one, float other) {
    return !(one > 0.0F && other > 0.0F && std::abs(one + other - 2.0F * z) < most);
  };
  return !bends(depth.z_m(u - d, v), depth.z_m(u + d, v)) &&
         !bends(depth.z_m(u, v - d), depth.z_m(u, v + d));
}

}  // namespace

void FloorTracker::TakeSamples(const DepthView& depth, const std::vector<std::uint8_t>& is_sound) {
  const DepthCamera& camera = depth.camera();
  const int step = std::max(1, camera.width_px / kColumns);
  grid_columns_ = (camera.width_px + step - 1) / step;
  grid_rows_ = (camera.height_px + step - 1) / step;
  const auto nodes = static_cast<std::size_t>(grid_columns_ * grid_rows_);
  for (auto* array : {&ray_x_, &ray_y_, &inverse_z_, &sigma_}) {
    array->reserve(nodes);
    array->clear();
  }
  grid_.assign(nodes, -1);
  sample_area_ = step * step / camera.focal_px.prod();
  const StepLimit limit = StepLimitOf(camera, kSmoothSigmas, kSmoothSlope);
  const auto farthest = static_cast<float>(config_.farthest_m);
  for (int row = 0; row < grid_rows_; ++row) {
    const int v = row * step;
    const auto ray_y = static_cast<float>((v - camera.centre_px.y()) / camera.focal_px.y());
    for (int column = 0; column < grid_columns_; ++column) {
      const int u = column * step;
      const float z = depth.z_m(u, v);
      const auto pixel = static_cast<std::size_t>(v * camera.width_px + u);
      if (is_sound[pixel] == 0 || z > farthest || !IsSmooth(depth, u, v, limit)) continue;
      grid_[static_cast<std::size_t>(row * grid_columns_ + column)] =
          static_cast<int>(ray_x_.size());
      ray_x_.push_back(static_cast<float>((u - camera.centre_px.x()) / camera.focal_px.x()));
      ray_y_.push_back(ray_y);
      inverse_z_.push_back(1.0F / z);
      sigma_.push_back(static_cast<float>(camera.noise.Sigma_m(z)) / (z * z));
    }
  }
}

std::optional<FloorTracker::Slopes> FloorTracker::Search() const {
  if (static_cast<int>(ray_x_.size()) < kLeastSamples) return std::nullopt;
  struct Finalist {
    double score = 0.0;
    Slopes slopes;
  };
  std::array<Finalist, kFinalists> best;
  int weighed = 0;
  for (std::uint64_t i = 0; i < kDraws && weighed < kHypotheses; ++i) {
    const auto slopes = i == 0 && known_ ? std::optional(SlopesOf(*known_)) : Hypothesis(i);
    if (!slopes || !MayBeFloor(*slopes)) continue;
    ++weighed;
    const double score = Score(*slopes);
    if (score <= best.back().score) continue;
    best.back() = {score, *slopes};
    std::sort(best.begin(), best.end(),
              [](const Finalist& a, const Finalist& b) { return a.score > b.score; });
  }
  std::optional<Slopes> winner;
  double winning_score = 0.0;
  for (const Finalist& finalist : best) {
    if (finalist.score <= 0.0) break;
    Equations unused;
    const auto refined = Refined(finalist.slopes, unused);
    if (!refined) continue;
    const double score = Score(*refined);
    if (score > winning_score) {
      winning_score = score;
      winner = refined;
    }
  }
  return winner;
}

/// Through three samples that lie near one another in the image, so that one surface is likely; the
/// first rather low in it, where floors are.
std::optional<FloorTracker::Slopes> FloorTracker::Hypothesis(std::uint64_t number) const {
  const filtering::CounterRandom random(kSeed, number);
  const auto pick = [&random](std::uint64_t counter, int low, int high) {
    return low + static_cast<int>(random.Uniform(counter) * static_cast<float>(high - low));
  };
  const int reach = std::max(2, grid_columns_ >> (2 + number % 3));
  const int column = pick(0, 0, grid_columns_);
  const int row = std::max(pick(1, 0, grid_rows_), pick(2, 0, grid_rows_));
  const int first = SampleAt(column, row);
  if (first < 0) return std::nullopt;
  std::array<int, 3> chosen = {first, -1, -1};
  for (std::uint64_t i = 1, counter = 3; i < 3; ++i) {
    for (int attempt = 0; attempt < kAttempts && chosen[i] < 0; ++attempt, counter += 2) {
      chosen[i] = SampleAt(column + pick(counter, -reach, reach + 1),
                           row + pick(counter + 1, -reach, reach + 1));
    }
    if (chosen[i] < 0) return std::nullopt;
  }
  Eigen::Matrix3d rays;
  Eigen::Vector3d inverse;
  for (int i = 0; i < 3; ++i) {
    const auto sample = static_cast<std::size_t>(chosen[static_cast<std::size_t>(i)]);
    rays.row(i) << static_cast<double>(ray_x_[sample]), static_cast<double>(ray_y_[sample]), 1.0;
    inverse[i] = static_cast<double>(inverse_z_[sample]);
  }
  if (std::abs(rays.determinant()) < kLeastSpread) return std::nullopt;
  return Slopes(rays.inverse() * inverse);
}

int FloorTracker::SampleAt(int column, int row) const {
  if (column < 0 || row < 0 || column >= grid_columns_ || row >= grid_rows_) return -1;
  return grid_[static_cast<std::size_t>(row * grid_columns_ + column)];
}

bool FloorTracker::MayBeFloor(const Slopes& slopes) const {
  if (!slopes.allFinite() || slopes.norm() < 1e-3) return false;
  const body_model::Floor floor = FloorOf(slopes);
  const Eigen::Vector3d& up = floor.normal;
  if (floor.offset_m < config_.lowest_camera_m || floor.offset_m > config_.highest_camera_m) {
    return false;
  }
  if (known_) {
    return AngleBetween(up, known_->normal) < Radians(config_.known_tilt_deg) &&
           std::abs(floor.offset_m - known_->offset_m) < config_.known_height_m;
  }
  return up.y() < 0.0 &&
         std::abs(std::atan2(up.x(), -up.y())) < Radians(config_.largest_roll_deg) &&
         std::abs(std::asin(std::clamp(up.z(), -1.0, 1.0))) < Radians(config_.largest_pitch_deg);
}

double FloorTracker::Score(const Slopes& slopes) const {
  const FloorSupport support = SupportOf(samples(), PlaneOf(slopes), kSearchTolerance);
  return static_cast<double>(support.on) - kBelowPenalty * static_cast<double>(support.below);
}

/// A pixel of a plane covers z^3 / height of it, of which the kernel takes z^2: what is seen head
/// on.
bool FloorTracker::HasSupport(const Slopes& slopes) const {
  const FloorSupport support = SupportOf(samples(), PlaneOf(slopes), kSearchTolerance);
  const FloorSupport close = SupportOf(samples(), PlaneOf(slopes), kCloseTolerance);
  const bool is_large = static_cast<double>(support.on) * sample_area_ > kLarge_m2;
  const float least_close = is_large ? kLargeClose : kClose;
  const double facing = 0.25;  // How much a floor is foreshortened, roughly.
  return static_cast<double>(support.on) * sample_area_ > facing * config_.least_area_m2 &&
         support.on > 4.0F * support.below && (known_ || close.on > least_close * support.on);
}

std::optional<FloorTracker::Slopes> FloorTracker::Refined(Slopes slopes,
                                                          Equations& equations) const {
  for (int i = 0; i < kRefinements; ++i) {
    const auto sums = EquationsOf(samples(), PlaneOf(slopes),
                                  i + 1 < kRefinements ? kTrackTolerance : kFineTolerance);
    if (sums.count < static_cast<float>(kLeastSamples)) return std::nullopt;
    const Eigen::Matrix3f left = (Eigen::Matrix3f() << sums.xx, sums.xy, sums.x, sums.xy, sums.yy,
                                  sums.y, sums.x, sums.y, sums.one)
                                     .finished();
    equations.left = left.cast<double>();
    equations.right = Eigen::Vector3f(sums.xq, sums.yq, sums.q).cast<double>();
    slopes = equations.left.inverse() * equations.right;
    if (!slopes.allFinite() || !MayBeFloor(slopes)) return std::nullopt;
  }
  return HasSupport(slopes) ? std::optional(slopes) : std::nullopt;
}

void FloorTracker::Remember(const Slopes& seen, const Equations& equations, double elapsed_s) {
  const body_model::Floor now = FloorOf(seen);
  const bool is_same = slopes_ &&
                       AngleBetween(now.normal, FloorOf(*slopes_).normal) < kSameTilt_rad &&
                       std::abs(now.offset_m - FloorOf(*slopes_).offset_m) < kSameHeight_m;
  const double kept = is_same ? std::exp(-elapsed_s / config_.smooth_time_s) : 0.0;
  memory_.left = kept * memory_.left + equations.left;
  memory_.right = kept * memory_.right + equations.right;
  const Slopes smooth = memory_.left.inverse() * memory_.right;
  slopes_ = smooth.allFinite() && MayBeFloor(smooth) ? smooth : seen;
}

}  // namespace deixis::pose_fitter
