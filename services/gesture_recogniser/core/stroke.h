#pragma once
#include <vector>

#include "common/config/config.h"
#include "services/gesture_recogniser/core/gesture_model.h"
#include "services/gesture_recogniser/core/motion_features.h"

namespace deixis::gesture_recogniser {

struct StrokeConfig {
  double spread_factor = 1.5;       ///< Widens the spreads of duration and peak speed.
  int amplitudes = 12;              ///< Peak speeds that are tried.
  double noise_ratio = 0.75;        ///< Noise of speeds over that of independent positions.
  double free_slow_m_per_s = 0.15;  ///< Free motion: mean speed of its slow half.
  double free_fast_m_per_s = 1.2;   ///< ... and of its fast half.
  double resting_m_per_s = 0.06;    ///< Speed of a resting hand without noise.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("spread_factor", spread_factor);
    v("amplitudes", amplitudes);
    v("noise_ratio", noise_ratio);
    v("free_slow_m_per_s", free_slow_m_per_s);
    v("free_fast_m_per_s", free_fast_m_per_s);
    v("resting_m_per_s", resting_m_per_s);
  }
  void Validate() const;
};

/// How well a model's stroke explains the motion that ended some steps ago.
struct StrokeEvidence {
  double log_odds = 0.0;    ///< log p(motion | stroke) - log p(motion | free or resting).
  double duration_s = 0.0;  ///< Of the most probable stroke.
};

/// Compares the speeds of a hand with a model's stroke: summed exactly over a grid of durations
/// (rho) and peak speeds (alpha) rather than sampled.
class Stroke {
 public:
  Stroke(const StrokeConfig& config, const GestureModel& model, double step_s);

  /// Looks at the whole motion once; `At` then answers for every arrival up to `latest` steps ago.
  void Observe(const Motion& motion, int latest);
  /// For a stroke that arrived `steps_ago`; log_odds is -infinity where the motion is too short.
  const StrokeEvidence& At(int steps_ago) const {
    return evidence_[static_cast<std::size_t>(steps_ago)];
  }

 private:
  struct Duration {
    int steps = 0;
    double log_prior = 0.0;
    std::vector<float> mean;  // Per lag x amplitude.
    std::vector<float> inverse_sd;
    std::vector<float> log_norm;
    std::vector<double> shape;  // Per lag.
    std::vector<double> shape_spread;
  };

  void FillShapes(const GestureModel& model, double step_s);
  void FitNoise(double noise_m_per_s);
  void FitNoise(Duration& duration) const;
  void Accumulate(const Motion& motion);
  StrokeEvidence Evaluate(const Motion& motion, int steps_ago);
  double LogOdds(const Motion& motion, int steps_ago, const Duration& duration);
  double LogNull(int steps_ago, int steps) const;

  StrokeConfig config_;
  std::vector<double> amplitude_m_per_s_;
  std::vector<double> amplitude_log_prior_;
  std::vector<Duration> durations_;
  double noise_m_per_s_ = -1.0;   // That the tables are made for.
  std::vector<double> free_sum_;  // Log-density of free motion, summed from now backwards.
  std::vector<double> rest_sum_;
  std::vector<float> sums_;  // Scratch, one per amplitude.
  std::vector<StrokeEvidence> evidence_;
};

}  // namespace deixis::gesture_recogniser
