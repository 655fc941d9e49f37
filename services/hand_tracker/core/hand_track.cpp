#include "services/hand_tracker/core/hand_track.h"

#include <algorithm>
#include <cmath>

namespace deixis::hand_tracker {
namespace {

constexpr double kJump = 30.0;  // Squared Mahalanobis distance beyond which a motion is no motion.

filtering::ConstantAccelerationFilter NewFilter(const HandTrackConfig& config, double position,
                                                double hand_length_px) {
  constexpr double kSpeedSigma = 3.0;          // Hand lengths per second ...
  constexpr double kAccelerationSigma = 30.0;  // ... and per second squared.
  const filtering::ConstantAccelerationModel model{
      config.jerk_density * hand_length_px * hand_length_px, config.acceleration_time_s};
  return {model,
          {position, 0.0, 0.0},
          hand_length_px * Eigen::Vector3d(config.centre_noise, kSpeedSigma, kAccelerationSigma)};
}

}  // namespace

void HandTrackConfig::Validate() const {
  config::Faults faults;
  faults.Require(jerk_density > 0.0, "jerk_density", "must be positive");
  faults.Require(acceleration_time_s >= 0.0, "acceleration_time_s", "must not be negative");
  faults.Require(centre_noise > 0.0, "centre_noise", "must be positive");
  faults.Require(shared_noise > 0.0, "shared_noise", "must be positive");
  faults.Require(hide_time_s >= 0.0, "hide_time_s", "must not be negative");
  faults.ThrowIfAny();
}

HandTrack::HandTrack(int id, const HandTrackConfig& config, const HandCandidate& candidate)
    : id_(id),
      config_(config),
      hand_length_px_(candidate.hand_length_px),
      x_(NewFilter(config, candidate.centre.x(), hand_length_px_)),
      y_(NewFilter(config, candidate.centre.y(), hand_length_px_)),
      latest_(candidate) {}

void HandTrack::Predict(double elapsed_s) {
  x_.Predict(elapsed_s);
  y_.Predict(elapsed_s);
}

void HandTrack::Measure(const HandCandidate& candidate, Sight sight) {
  hand_length_px_ = candidate.hand_length_px;
  latest_ = candidate;
  if (SquaredDistance(candidate.centre) > kJump) {
    Restart(candidate.centre);
  } else {
    const double noise = sight == Sight::kShared ? config_.shared_noise : config_.centre_noise;
    Correct(candidate.centre, noise * hand_length_px_);
  }
  state_ = scene::HandState::kMeasured;
  unseen_s_ = 0.0;
}

void HandTrack::Merge(const Eigen::Vector2d& centre, double sigma_px, double unseen_s,
                      double elapsed_s) {
  Correct(centre, sigma_px);
  state_ = scene::HandState::kMerged;
  unseen_s_ = unseen_s;
  SlowDown(elapsed_s);
}

void HandTrack::Miss(double unseen_s, double elapsed_s) {
  unseen_s_ = unseen_s;
  const bool is_hidden = unseen_s_ > config_.hide_time_s;
  state_ = is_hidden ? scene::HandState::kOccluded : scene::HandState::kPredicted;
  SlowDown(elapsed_s);
}

/// A hand that went out of sight is looked for where it vanished, not where its speed would take
/// it.
void HandTrack::SlowDown(double elapsed_s) {
  constexpr double kTime_s = 0.07;
  const double share = std::exp(-elapsed_s / kTime_s);
  x_.Slow(share);
  y_.Slow(share);
}

/// Found again elsewhere: the way between tells nothing about its speed.
void HandTrack::Restart(const Eigen::Vector2d& centre) {
  x_ = NewFilter(config_, centre.x(), hand_length_px_);
  y_ = NewFilter(config_, centre.y(), hand_length_px_);
}

void HandTrack::Correct(const Eigen::Vector2d& centre, double sigma_px) {
  x_.Update(centre.x(), sigma_px);
  y_.Update(centre.y(), sigma_px);
}

double HandTrack::SquaredDistance(const Eigen::Vector2d& centre) const {
  const double noise = config_.centre_noise * hand_length_px_;
  const double variance_x = x_.covariance()(0, 0) + noise * noise;
  const double variance_y = y_.covariance()(0, 0) + noise * noise;
  const Eigen::Vector2d offset = centre - this->centre();
  return offset.x() * offset.x() / variance_x + offset.y() * offset.y() / variance_y;
}

Eigen::Matrix4d HandTrack::Covariance() const {
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  for (const auto& [filter, axis] : {std::pair{&x_, 0}, std::pair{&y_, 1}}) {
    covariance(axis, axis) = filter->covariance()(0, 0);
    covariance(axis, axis + 2) = covariance(axis + 2, axis) = filter->covariance()(0, 1);
    covariance(axis + 2, axis + 2) = filter->covariance()(1, 1);
  }
  return covariance;
}

}  // namespace deixis::hand_tracker
