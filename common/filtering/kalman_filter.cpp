#include "common/filtering/kalman_filter.h"

#include <cmath>

namespace deixis::filtering {
namespace {

/// State transition over `t` seconds; `decay_s` = 0 keeps the acceleration (Singer's model
/// otherwise).
Eigen::Matrix3d Transition(double t, double decay_s) {
  Eigen::Matrix3d transition = Eigen::Matrix3d::Identity();
  transition(0, 1) = t;
  if (decay_s <= 0.0) {
    transition(0, 2) = 0.5 * t * t;
    transition(1, 2) = t;
    return transition;
  }
  const double kept = std::exp(-t / decay_s);
  transition(0, 2) = decay_s * decay_s * (kept - 1.0 + t / decay_s);
  transition(1, 2) = decay_s * (1.0 - kept);
  transition(2, 2) = kept;
  return transition;
}

/// Covariance that white jerk of unit density adds in `t` seconds.
Eigen::Matrix3d JerkNoise(double t) {
  const double t2 = t * t;
  const double t3 = t2 * t;
  const double t4 = t3 * t;
  const double t5 = t4 * t;
  return (Eigen::Matrix3d() << t5 / 20.0, t4 / 8.0, t3 / 6.0,  //
          t4 / 8.0, t3 / 3.0, t2 / 2.0,                        //
          t3 / 6.0, t2 / 2.0, t)
      .finished();
}

}  // namespace

ConstantAccelerationFilter::ConstantAccelerationFilter(const ConstantAccelerationModel& model,
                                                       const Eigen::Vector3d& state,
                                                       const Eigen::Vector3d& sigma)
    : model_(model), state_(state), covariance_(sigma.cwiseAbs2().asDiagonal()) {}

void ConstantAccelerationFilter::Predict(double elapsed_s) {
  const Eigen::Matrix3d transition = Transition(elapsed_s, model_.acceleration_time_s);
  state_ = transition * state_;
  covariance_ = transition * covariance_ * transition.transpose() +
                model_.jerk_density * JerkNoise(elapsed_s);
}

void ConstantAccelerationFilter::Update(double position, double sigma) {
  const Eigen::Vector3d gain = covariance_.col(0) / (covariance_(0, 0) + sigma * sigma);
  state_ += gain * (position - state_[0]);
  // Joseph's form: stays symmetric and positive whatever the rounding.
  Eigen::Matrix3d keep = Eigen::Matrix3d::Identity();
  keep.col(0) -= gain;
  covariance_ = keep * covariance_ * keep.transpose() + sigma * sigma * gain * gain.transpose();
}

void ConstantAccelerationFilter::Slow(double share) { state_.tail<2>() *= share; }

}  // namespace deixis::filtering
