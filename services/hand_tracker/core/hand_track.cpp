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
  const auto require = [&faults](double value, const char* key) {
    faults.Require(value > 0.0, key, "must be positive");
  };
  require(jerk_density, "jerk_density");
  require(centre_noise, "centre_noise");
  require(confirm_credit, "confirm_credit");
  require(moving_credit, "moving_credit");
  require(idle_credit, "idle_credit");
  require(forget_time_s, "forget_time_s");
  require(merge_time_s, "merge_time_s");
  faults.Require(acceleration_time_s >= 0.0, "acceleration_time_s", "must not be negative");
  faults.Require(largest_credit > confirm_credit, "largest_credit", "must exceed confirm_credit");
  faults.Require(moving_share >= 0.0, "moving_share", "must not be negative");
  faults.Require(hide_time_s >= 0.0 && hide_time_s <= forget_time_s, "hide_time_s",
                 "must lie between 0 and forget_time_s");
  faults.ThrowIfAny();
}

HandTrack::HandTrack(int id, const HandTrackConfig& config, const HandCandidate& candidate)
    : id_(id),
      config_(config),
      hand_length_px_(candidate.hand_length_px),
      x_(NewFilter(config, candidate.centre.x(), hand_length_px_)),
      y_(NewFilter(config, candidate.centre.y(), hand_length_px_)),
      latest_(candidate),
      liveliness_(candidate.moving_share) {}

void HandTrack::Predict(double elapsed_s) {
  x_.Predict(elapsed_s);
  y_.Predict(elapsed_s);
}

void HandTrack::Measure(const HandCandidate& candidate, double elapsed_s) {
  hand_length_px_ = candidate.hand_length_px;
  latest_ = candidate;
  constexpr double kFreshShare = 0.35;
  still_s_ = candidate.fresh_share > kFreshShare ? 0.0 : still_s_ + elapsed_s;
  ++n_measurements_;
  if (SquaredDistance(candidate.centre) > kJump) {
    Restart(candidate.centre);
  } else {
    Correct(candidate.centre, config_.centre_noise * hand_length_px_);
  }
  state_ = scene::HandState::kMeasured;
  unseen_s_ = 0.0;
  merged_s_ = 0.0;
  EarnCredit(elapsed_s);
}

void HandTrack::Merge(const Eigen::Vector2d& centre, double sigma_px, double elapsed_s) {
  Correct(centre, sigma_px);
  still_s_ += elapsed_s;
  state_ = scene::HandState::kMerged;
  unseen_s_ = 0.0;
  merged_s_ += elapsed_s;
  FollowLiveliness(0.3, elapsed_s);
  SlowDown(elapsed_s);
}

void HandTrack::Miss(double elapsed_s) {
  unseen_s_ += elapsed_s;
  still_s_ += elapsed_s;
  FollowLiveliness(0.0, elapsed_s);
  const bool is_hidden = unseen_s_ > config_.hide_time_s;
  state_ = is_hidden ? scene::HandState::kOccluded : scene::HandState::kPredicted;
  SlowDown(elapsed_s);
}

void HandTrack::ContinueAs(const HandTrack& newcomer) {
  x_ = newcomer.x_;
  y_ = newcomer.y_;
  latest_ = newcomer.latest_;
  hand_length_px_ = newcomer.hand_length_px_;
  liveliness_ = newcomer.liveliness_;
  state_ = newcomer.state_;
  unseen_s_ = newcomer.unseen_s_;
  merged_s_ = newcomer.merged_s_;
  still_s_ = newcomer.still_s_;
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

/// People sway: of a hand at rest most pixels change within a second, of a thing beside it few do.
void HandTrack::EarnCredit(double elapsed_s) {
  const bool is_moving = latest_.moving_share > config_.moving_share;
  credit_ += elapsed_s * (is_moving ? config_.moving_credit : -config_.idle_credit);
  credit_ = std::min(credit_, config_.largest_credit);
  FollowLiveliness(latest_.moving_share, elapsed_s);
}

void HandTrack::FollowLiveliness(double share, double elapsed_s) {
  constexpr double kTime_s = 1.0;
  liveliness_ += (1.0 - std::exp(-elapsed_s / kTime_s)) * (share - liveliness_);
}

double HandTrack::SquaredDistance(const Eigen::Vector2d& centre) const {
  const double noise = config_.centre_noise * hand_length_px_;
  const double variance_x = x_.covariance()(0, 0) + noise * noise;
  const double variance_y = y_.covariance()(0, 0) + noise * noise;
  const Eigen::Vector2d offset = centre - this->centre();
  return offset.x() * offset.x() / variance_x + offset.y() * offset.y() / variance_y;
}

bool HandTrack::IsLively() const { return credit_ > 0.0; }

bool HandTrack::IsOver() const {
  constexpr double kTentativeUnseen_s = 0.15;
  constexpr double kNoCredit = -0.5;
  if (!is_confirmed_ && unseen_s_ > kTentativeUnseen_s) return true;
  return is_dismissed_ || unseen_s_ > config_.forget_time_s || merged_s_ > config_.merge_time_s ||
         credit_ < kNoCredit;
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
