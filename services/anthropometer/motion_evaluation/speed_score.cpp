#include "services/anthropometer/motion_evaluation/speed_score.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/body_model/kinematics.h"

namespace deixis::anthropometer {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using range_of_motion::ModelJoint;

constexpr double kDegreesPerRadian = 180.0 / M_PI;
constexpr double kUsualShare = 0.999;

Vector3d RotationVector(const Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

/// Orientation of the joint's last limb in its parent, frame by frame.
std::vector<Matrix3d> OrientationsOf(const retargeting::BodyMotion& motion,
                                     const ModelJoint& joint) {
  body_model::Kinematics kinematics(motion.model);
  std::vector<Matrix3d> orientations;
  for (const body_model::BodyPose& pose : motion.poses) {
    kinematics.Update(pose);
    orientations.emplace_back(kinematics.limb(joint.parent).linear().transpose() *
                              kinematics.limb(joint.limb).linear());
  }
  return orientations;
}

double ShareAbove(const std::vector<double>& samples, double limit) {
  if (samples.empty()) return 0.0;
  const auto above = std::count_if(samples.begin(), samples.end(),
                                   [limit](double sample) { return sample > limit; });
  return static_cast<double>(above) / static_cast<double>(samples.size());
}

double LargestOf(const std::vector<double>& samples) {
  return samples.empty() ? 0.0 : *std::max_element(samples.begin(), samples.end());
}

double UpToTens(double value) { return 10.0 * std::ceil(value / 10.0); }

}  // namespace

void AddSpeeds(const retargeting::BodyMotion& motion, const Judges& judges, SpeedSamples& samples) {
  const auto step =
      static_cast<std::size_t>(std::lround(SpeedSamples::kStep_s * motion.frame_rate_hz));
  if (step == 0) throw std::invalid_argument("frames lie too far apart to tell speeds");
  const double step_s = static_cast<double>(step) / motion.frame_rate_hz;
  const range_of_motion::RangeOfMotion ranges(motion.model, judges.plan, judges.rows);
  const std::vector<bool> faults = FindFaults(motion, judges);
  for (std::size_t k = 0; k < faults.size(); ++k) {
    if (faults[k]) continue;
    const ModelJoint& joint = ranges.joints()[k];
    const std::vector<Matrix3d> at = OrientationsOf(motion, joint);
    std::vector<Vector3d> rates;
    for (std::size_t i = 0; i + step < at.size(); ++i) {
      rates.emplace_back(at[i] * RotationVector(at[i].transpose() * at[i + step]) / step_s);
      samples.speeds[joint.joint.joint()].push_back(kDegreesPerRadian * rates.back().norm());
    }
    for (std::size_t i = 0; i + step < rates.size(); ++i) {
      samples.accelerations[joint.joint.joint()].push_back(
          kDegreesPerRadian * (rates[i + step] - rates[i]).norm() / step_s);
    }
  }
}

double Quantile(std::vector<double> samples, double share) {
  if (samples.empty()) return 0.0;
  const auto place = static_cast<std::ptrdiff_t>(
      std::min(share, 1.0) * static_cast<double>(samples.size() - 1) + 0.5);
  std::nth_element(samples.begin(), samples.begin() + place, samples.end());
  return samples[static_cast<std::size_t>(place)];
}

std::vector<range_of_motion::JointSpeed> LimitsFrom(const SpeedSamples& samples, double reserve) {
  std::vector<range_of_motion::JointSpeed> limits;
  for (const auto& [joint, speeds] : samples.speeds) {
    const auto sudden = samples.accelerations.find(joint);
    if (sudden == samples.accelerations.end()) continue;
    limits.push_back({joint, UpToTens(reserve * Quantile(speeds, kUsualShare)),
                      UpToTens(reserve * Quantile(sudden->second, kUsualShare))});
  }
  return limits;
}

std::vector<SpeedScore> ScoreSpeeds(const SpeedSamples& samples,
                                    const range_of_motion::SpeedLimits& limits) {
  std::vector<SpeedScore> scores;
  for (const auto& [joint, speeds] : samples.speeds) {
    const range_of_motion::JointSpeed* limit = limits.Find(joint);
    const auto sudden = samples.accelerations.find(joint);
    if (limit == nullptr || sudden == samples.accelerations.end()) continue;
    scores.push_back({joint, static_cast<long>(speeds.size()),
                      ShareAbove(speeds, limit->speed_deg_per_s),
                      ShareAbove(sudden->second, limit->acceleration_deg_per_s2), LargestOf(speeds),
                      LargestOf(sudden->second)});
  }
  return scores;
}

}  // namespace deixis::anthropometer
