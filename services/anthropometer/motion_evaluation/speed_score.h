#pragma once
#include <map>
#include <string>
#include <vector>

#include "common/range_of_motion/range_of_motion.h"
#include "common/range_of_motion/speed_limits.h"
#include "common/retargeting/retarget.h"
#include "services/anthropometer/motion_evaluation/motion_score.h"

namespace deixis::anthropometer {

/// How fast the joints of recordings turn, degrees per second and per second squared: differences
/// over `kStep_s`, so that files of any frame rate and the noise of their solvers compare.
struct SpeedSamples {
  static constexpr double kStep_s = 1.0 / 30.0;

  std::map<std::string, std::vector<double>> speeds, accelerations;  ///< By joint of either side.
};

/// Adds the joints that the recording has right. Throws std::invalid_argument when its frames lie
/// farther apart than kStep_s.
void AddSpeeds(const retargeting::BodyMotion& motion, const Judges& judges, SpeedSamples& samples);

/// The value that a share of the samples does not exceed; 0 of none.
double Quantile(std::vector<double> samples, double share);

/// Limits `reserve` times what all but a share of 0.001 of the samples keep to, rounded up to tens.
std::vector<range_of_motion::JointSpeed> LimitsFrom(const SpeedSamples& samples, double reserve);

/// Shares of samples beyond the limits.
struct SpeedScore {
  std::string joint;
  long samples = 0;
  double too_fast = 0.0, too_sudden = 0.0;
  double fastest_deg_per_s = 0.0, most_sudden_deg_per_s2 = 0.0;
};
std::vector<SpeedScore> ScoreSpeeds(const SpeedSamples& samples,
                                    const range_of_motion::SpeedLimits& limits);

}  // namespace deixis::anthropometer
