#pragma once
#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "common/body_model/kinematics.h"
#include "services/pose_fitter/core/shape/shape_calibration.h"

namespace deixis::pose_fitter {

/// Normal equations of one frame: its pose p and the shape s.
struct FrameEquations {
  Eigen::MatrixXd pose_pose, pose_shape, shape_shape;
  Eigen::VectorXd pose, shape;  ///< Right-hand sides.
};

/// A shape with all poses.
struct ShapeState {
  Eigen::VectorXd values;
  std::vector<body_model::BodyPose> poses;
};

/// Squared errors, in their variances, that are to become smallest: distances of the points from
/// their limbs' surfaces (robust), poses from where they began, parameters from their prior.
class ShapeProblem {
 public:
  /// All must outlive it.
  ShapeProblem(const ShapeParameters& parameters, const std::vector<ShapeFrame>& frames,
               const ShapeConfig& config);

  ShapeState Start() const;
  double Cost(const ShapeState& state) const;
  std::vector<FrameEquations> Equations(const ShapeState& state) const;
  /// Information of the shape when all poses are free, and the right-hand side of its step.
  std::pair<Eigen::MatrixXd, Eigen::VectorXd> Reduced(const std::vector<FrameEquations>& frames,
                                                      const Eigen::VectorXd& values,
                                                      double damping) const;
  ShapeState Stepped(const ShapeState& state, const std::vector<FrameEquations>& frames,
                     double damping) const;
  /// Root mean square of the errors of points that explain something, in standard deviations.
  double Rms(const ShapeState& state) const;

 private:
  FrameEquations EquationsOf(const body_model::BodyModel& model,
                             const std::vector<body_model::BodyModel>& changed,
                             const body_model::BodyPose& pose, const ShapeFrame& frame) const;

  const ShapeParameters& parameters_;
  const std::vector<ShapeFrame>& frames_;
  const ShapeConfig& config_;
  Eigen::Index poses_, shapes_;
  Eigen::VectorXd pose_information_, shape_information_;
};

}  // namespace deixis::pose_fitter
