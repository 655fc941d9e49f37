#pragma once
#include <Eigen/Core>

#include "common/body_model/body_model.h"
#include "services/pose_fitter/core/fitting/fit_result.h"

namespace deixis::pose_fitter {

/// One of the poses that may be a person's.
struct Hypothesis {
  body_model::BodyPose pose;
  Eigen::Vector3d velocity_m_per_s = Eigen::Vector3d::Zero();     ///< Of the root.
  Eigen::Vector3d turn_rate_rad_per_s = Eigen::Vector3d::Zero();  ///< Of the root, in the frame.
  Eigen::VectorXd rates_rad_per_s;                                ///< Of the angles.
  FitResult result;
  Eigen::MatrixXd information;  ///< Of its last fit, in the order of body_model::PointJacobian;
                                ///< 0 x 0 = not known.
  double mean_score = 0.0;      ///< Of the last few images; smaller is better.
  double handicap = 0.0;        ///< In each score, beside what the images say.
  double worst_score = 0.0;     ///< Mean scores above it are nobody's; until somebody is proven.
  double age_s = 0.0;
};

/// Where it will be after `seconds`, when `share` of its motion goes on.
body_model::BodyPose Predict(const Hypothesis& hypothesis, double seconds, double share);

/// Whether the one looks where the other turns its back.
bool IsTurnedAbout(const body_model::BodyPose& pose, const body_model::BodyPose& other);

/// Takes over a fitted pose, `seconds` after the last one, with the motion that it tells.
void Move(const body_model::BodyPose& pose, double seconds, Hypothesis& hypothesis);

}  // namespace deixis::pose_fitter
