#pragma once
#include <Eigen/Core>

#include "common/config/config.h"
#include "common/filtering/kalman_filter.h"
#include "common/scene/hand.h"
#include "services/hand_tracker/core/hand_candidates.h"

namespace deixis::hand_tracker {

struct HandTrackConfig {
  double jerk_density = 2.0e4;        ///< How abruptly hands move, hand_lengths^2/s^5.
  double acceleration_time_s = 0.15;  ///< In which a hand's acceleration dies away.
  double centre_noise = 0.1;          ///< Sigma of a measured centre, hand lengths.
  double shared_noise = 0.25;         ///< The same where both hands are one lump.
  double hide_time_s = 0.3;           ///< Unseen this long: OCCLUDED, no longer PREDICTED.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("jerk_density", jerk_density);
    v("acceleration_time_s", acceleration_time_s);
    v("centre_noise", centre_noise);
    v("shared_noise", shared_noise);
    v("hide_time_s", hide_time_s);
  }
  void Validate() const;
};

/// One hand over time, its motion smoothed by a Kalman filter. Full image pixels.
class HandTrack {
 public:
  HandTrack(int id, const HandTrackConfig& config, const HandCandidate& candidate);

  void Predict(double elapsed_s);
  /// Whether a candidate shows this hand alone, or another one as well.
  enum class Sight { kAlone, kShared };
  void Measure(const HandCandidate& candidate, Sight sight);
  /// Nothing of its own was found for `unseen_s`, but it may be within what is at `centre`, which
  /// is known to `sigma_px`.
  void Merge(const Eigen::Vector2d& centre, double sigma_px, double unseen_s, double elapsed_s);
  /// Nothing was found for `unseen_s`.
  void Miss(double unseen_s, double elapsed_s);

  double unseen_s() const { return unseen_s_; }  ///< Since it was last found.
  int id() const { return id_; }
  scene::HandState state() const { return state_; }
  Eigen::Vector2d centre() const { return {x_.position(), y_.position()}; }
  Eigen::Vector2d velocity() const { return {x_.velocity(), y_.velocity()}; }
  double hand_length_px() const { return hand_length_px_; }
  const HandCandidate& latest() const { return latest_; }
  Eigen::Matrix4d Covariance() const;  ///< Of centre and velocity.

 private:
  double SquaredDistance(const Eigen::Vector2d& centre) const;
  void Restart(const Eigen::Vector2d& centre);
  void Correct(const Eigen::Vector2d& centre, double sigma_px);
  void SlowDown(double elapsed_s);

  int id_;
  HandTrackConfig config_;
  double hand_length_px_;
  filtering::ConstantAccelerationFilter x_;
  filtering::ConstantAccelerationFilter y_;
  HandCandidate latest_;
  scene::HandState state_ = scene::HandState::kMeasured;
  double unseen_s_ = 0.0;
};

}  // namespace deixis::hand_tracker
