#pragma once
#include <Eigen/Core>

#include "common/config/config.h"
#include "services/gesture_recogniser/core/motion_features.h"

namespace deixis::gesture_recogniser {

struct HoldConfig {
  double shortest_s = 0.27;         ///< A hold must have lasted this long to count.
  double longest_s = 0.8;           ///< How much of a hold is looked at.
  double drift_m_per_s = 0.05;      ///< Drift of a hand that holds.
  double free_slow_m_per_s = 0.25;  ///< Free motion: spread of its drift, slow half.
  double free_fast_m_per_s = 1.2;   ///< ... and fast half.
  double tremor_factor = 1.4;       ///< Scatter of a held hand over the track's own sigma.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("shortest_s", shortest_s);
    v("longest_s", longest_s);
    v("drift_m_per_s", drift_m_per_s);
    v("free_slow_m_per_s", free_slow_m_per_s);
    v("free_fast_m_per_s", free_fast_m_per_s);
    v("tremor_factor", tremor_factor);
  }
  void Validate() const;
};

/// What the last samples say about the hand being held still.
struct HoldEvidence {
  double log_odds = 0.0;                                 ///< Held against moving on.
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< Mean position.
  double sigma_m = 0.0;                                  ///< Of that mean, per axis.
};

/// Judges the newest `samples` >= 2 samples of the motion.
HoldEvidence JudgeHold(const HoldConfig& config, const Motion& motion, int samples);

}  // namespace deixis::gesture_recogniser
