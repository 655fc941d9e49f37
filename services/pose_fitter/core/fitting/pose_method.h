#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/body_model/body_model.h"
#include "common/body_model/tracked_body.h"
#include "services/pose_fitter/core/fitting/body_evidence.h"
#include "services/pose_fitter/core/fitting/fit_result.h"

namespace deixis::pose_fitter {

/// A way to fit a body to what one depth image says of it.
class PoseMethod {
 public:
  virtual ~PoseMethod() = default;

  /// Improves `pose`. `predicted` is where it is expected, `seconds` after it was known (nothing =
  /// not known at all: no pull towards it). What it returns holds until the next fit.
  virtual const FitResult& Fit(const BodyEvidence& evidence,
                               const std::optional<body_model::Floor>& floor,
                               const body_model::BodyPose& predicted, std::optional<double> seconds,
                               body_model::BodyPose& pose) = 0;
  /// Of the last fit, in the order of body_model::PointJacobian; 0 x 0 = not known.
  virtual const Eigen::MatrixXd& information() const = 0;
  /// Limb of each point of the last fit's evidence; -1 = none.
  virtual const std::vector<int>& winners() const = 0;
};

}  // namespace deixis::pose_fitter
