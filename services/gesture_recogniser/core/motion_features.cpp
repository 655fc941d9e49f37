#include "services/gesture_recogniser/core/motion_features.h"

#include <algorithm>
#include <cmath>

#include "common/filtering/log_probability.h"

namespace deixis::gesture_recogniser {

using filtering::kTwoPi;

namespace {

double Heading(const Eigen::Vector2d& step) { return std::atan2(step.y(), step.x()); }

}  // namespace

double WrapAngle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, kTwoPi);
  return wrapped <= -0.5 * kTwoPi ? 0.5 * kTwoPi : wrapped;
}

void MotionConfig::Validate() const {
  config::Faults faults;
  faults.Require(step_s >= 0.01 && step_s <= 0.2, "step_s", "must lie in [0.01, 0.2]");
  faults.Require(history_s >= 10.0 * step_s && history_s <= 10.0, "history_s",
                 "must lie between 10 steps and 10 s");
  faults.Require(longest_gap_s >= step_s, "longest_gap_s", "must be at least one step");
  faults.ThrowIfAny();
}

void MotionHistory::ForgetPredictions() {
  while (!points_.empty() && !points_.front().is_measured) points_.pop_front();
}

std::optional<TrackPoint> MotionHistory::LastSight() const {
  for (const TrackPoint& point : points_) {
    if (point.is_measured) return point;
  }
  return std::nullopt;
}

bool MotionHistory::Add(const TrackPoint& point) {
  const double elapsed_s = points_.empty() ? 0.0 : SecondsBetween(points_.front().time, point.time);
  if (elapsed_s <= 0.0) points_.clear();
  if (point.is_measured) ForgetPredictions();
  if (!points_.empty() &&
      SecondsBetween(points_.front().time, point.time) > config_.longest_gap_s) {
    points_.clear();
  }
  const bool continues = !points_.empty();
  motion_.elapsed_s = continues ? elapsed_s : 0.0;
  points_.push_front(point);
  while (SecondsBetween(points_.back().time, point.time) > config_.history_s + config_.step_s) {
    points_.pop_back();
  }
  return continues;
}

const Motion& MotionHistory::Sample(double px_per_m) {
  motion_.step_s = config_.step_s;
  motion_.sigma_m = points_.empty() ? 0.0 : points_.front().sigma_px / px_per_m;
  SamplePositions(px_per_m);
  Differentiate();
  return motion_;
}

void MotionHistory::SamplePositions(double px_per_m) {
  motion_.position_m.clear();
  motion_.is_measured.clear();
  if (points_.empty()) return;
  // A step may fall a rounding error short of the oldest point.
  const double reach_s = SecondsBetween(points_.back().time, points_.front().time) + 1e-4;
  const int steps = static_cast<int>(std::min(reach_s, config_.history_s) / config_.step_s);
  std::size_t older = 0;
  for (int i = 0; i <= steps; ++i) {
    const double age_s = i * config_.step_s;
    while (older + 1 < points_.size() && Age(older) < age_s) ++older;
    SampleBetween(older > 0 ? older - 1 : 0, older, age_s, px_per_m);
  }
}

void MotionHistory::SampleBetween(std::size_t newer, std::size_t older, double age_s,
                                  double px_per_m) {
  const double span_s = Age(older) - Age(newer);
  const double share = span_s > 0.0 ? std::clamp((age_s - Age(newer)) / span_s, 0.0, 1.0) : 0.0;
  motion_.position_m.emplace_back(
      ((1.0 - share) * points_[newer].position_px + share * points_[older].position_px) / px_per_m);
  motion_.is_measured.push_back(points_[share > 0.5 ? older : newer].is_measured);
}

double MotionHistory::Age(std::size_t point) const {
  return SecondsBetween(points_[point].time, points_.front().time);
}

void MotionHistory::Differentiate() {
  const std::size_t size = motion_.size();
  const auto& position = motion_.position_m;
  motion_.speed_m_per_s.assign(size, 0.0);
  motion_.turn_rad.assign(size, 0.0);
  motion_.centred_speed_m_per_s.assign(size, 0.0);
  motion_.direction.setZero();
  for (std::size_t i = 0; i + 1 < size; ++i) {
    motion_.speed_m_per_s[i] = (position[i] - position[i + 1]).norm() / motion_.step_s;
    if (i + 2 < size) {
      motion_.turn_rad[i] = WrapAngle(Heading(position[i] - position[i + 1]) -
                                      Heading(position[i + 1] - position[i + 2]));
    }
    const std::size_t newer = i > 0 ? i - 1 : 0;
    motion_.centred_speed_m_per_s[i] = (position[newer] - position[i + 1]).norm() /
                                       (static_cast<double>(i + 1 - newer) * motion_.step_s);
  }
  if (size > 1) motion_.direction = (position[0] - position[1]).stableNormalized();
}

}  // namespace deixis::gesture_recogniser
