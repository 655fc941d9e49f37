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
  double centre_noise = 0.04;         ///< Sigma of a measured centre, hand lengths.
  double confirm_credit = 0.4;  ///< Credit (see HandTrack) from which a track counts as a hand.
  double moving_credit = 2.0;   ///< Earned per second of motion.
  double idle_credit = 0.25;    ///< Lost per second without motion.
  double largest_credit = 2.0;  ///< More is not kept.
  double moving_share = 0.45;   ///< Of its pixels must change for a hand to be said to move.
  double hide_time_s = 0.3;     ///< Unseen this long: behind something.
  double forget_time_s = 1.5;   ///< Unseen this long: given up.
  double merge_time_s = 2.5;    ///< The same while it may share a region with face or hand.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("jerk_density", jerk_density);
    v("acceleration_time_s", acceleration_time_s);
    v("centre_noise", centre_noise);
    v("confirm_credit", confirm_credit);
    v("moving_credit", moving_credit);
    v("idle_credit", idle_credit);
    v("largest_credit", largest_credit);
    v("moving_share", moving_share);
    v("hide_time_s", hide_time_s);
    v("forget_time_s", forget_time_s);
    v("merge_time_s", merge_time_s);
  }
  void Validate() const;
};

/// One hand over time. Full image pixels. Its credit says how much speaks for a hand rather than
/// for a thing of that colour: hands are never quite still; a track without credit is given up.
class HandTrack {
 public:
  HandTrack(int id, const HandTrackConfig& config, const HandCandidate& candidate);

  void Predict(double elapsed_s);
  void Measure(const HandCandidate& candidate, double elapsed_s);
  /// Nothing of its own was found, but it may be within what is at `centre`, which is known to
  /// `sigma`.
  void Merge(const Eigen::Vector2d& centre, double sigma_px, double elapsed_s);
  /// Nothing was found.
  void Miss(double elapsed_s);
  void Confirm() { is_confirmed_ = true; }
  void Dismiss() { is_dismissed_ = true; }  ///< Another track turned out to be the hand.

  /// Squared Mahalanobis distance of a measured centre.
  double SquaredDistance(const Eigen::Vector2d& centre) const;
  bool IsOver() const;    ///< Unseen for too long, or without credit.
  bool IsLively() const;  ///< Has credit left.
  double unseen_s() const { return unseen_s_; }
  double merged_s() const { return merged_s_; }
  double credit() const { return credit_; }
  double still_s() const { return still_s_; }  ///< Time since its region last moved afresh.
  /// Goes on with what `newcomer` knows: the hand went there faster than it could be followed.
  void ContinueAs(const HandTrack& newcomer);
  int n_measurements() const { return n_measurements_; }
  double liveliness() const { return liveliness_; }  ///< Recent mean of the moving share, 0..1.

  int id() const { return id_; }
  bool is_confirmed() const { return is_confirmed_; }
  scene::HandState state() const { return state_; }
  Eigen::Vector2d centre() const { return {x_.position(), y_.position()}; }
  Eigen::Vector2d velocity() const { return {x_.velocity(), y_.velocity()}; }
  double hand_length_px() const { return hand_length_px_; }
  const HandCandidate& latest() const { return latest_; }
  Eigen::Matrix4d Covariance() const;  ///< Of centre and velocity.

 private:
  void Restart(const Eigen::Vector2d& centre);
  void Correct(const Eigen::Vector2d& centre, double sigma_px);
  void EarnCredit(double elapsed_s);
  void FollowLiveliness(double share, double elapsed_s);
  void SlowDown(double elapsed_s);

  int id_;
  HandTrackConfig config_;
  double hand_length_px_;
  filtering::ConstantAccelerationFilter x_;
  filtering::ConstantAccelerationFilter y_;
  HandCandidate latest_;
  double still_s_ = 0.0;
  int n_measurements_ = 1;
  scene::HandState state_ = scene::HandState::kMeasured;
  bool is_confirmed_ = false;
  bool is_dismissed_ = false;
  double unseen_s_ = 0.0;
  double merged_s_ = 0.0;
  double credit_ = 0.0;
  double liveliness_ = 0.0;
};

}  // namespace deixis::hand_tracker
