#pragma once
#include <Eigen/Core>

namespace deixis::filtering {

/// How a point is expected to move along one axis. Units: those of the position, and seconds.
struct ConstantAccelerationModel {
  double jerk_density = 1.0;         ///< Spectral density of the acceleration's change, unit^2/s^5.
  double acceleration_time_s = 0.0;  ///< Time in which an acceleration dies away; 0 = never.
};

/// Kalman filter of position, velocity and acceleration along one axis. The acceleration is
/// constant but for white jerk (Bar-Shalom, Li, Kirubarajan 2001, section 6.2.3), or decays with a
/// time constant (Singer 1970), which keeps long predictions from running away.
class ConstantAccelerationFilter {
 public:
  ConstantAccelerationFilter(const ConstantAccelerationModel& model, const Eigen::Vector3d& state,
                             const Eigen::Vector3d& sigma);

  /// Moves the state `elapsed_s` >= 0 ahead.
  void Predict(double elapsed_s);
  /// Takes in a position measured with standard deviation `sigma` > 0.
  void Update(double position, double sigma);
  /// Slows down: velocity and acceleration are multiplied by `share` (0..1), their sigma kept.
  void Slow(double share);

  double position() const { return state_[0]; }
  double velocity() const { return state_[1]; }
  double acceleration() const { return state_[2]; }
  const Eigen::Matrix3d& covariance() const { return covariance_; }

 private:
  ConstantAccelerationModel model_;
  Eigen::Vector3d state_;
  Eigen::Matrix3d covariance_;
};

}  // namespace deixis::filtering
