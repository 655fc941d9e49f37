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
  double squares = 0.0;         ///< Of the errors of points that explain something, in variances.
  double count = 0.0;           ///< Of such points.
};

/// The body of one shape, and those with one parameter a step on each, for numeric derivatives.
class ShapeBodies {
 public:
  ShapeBodies(const ShapeParameters& parameters, const Eigen::VectorXd& values);

  void Update(const body_model::BodyPose& pose);
  const body_model::Kinematics& body() const { return body_; }
  /// By each parameter, of the distance along `normal` (camera's frame) of a measured point from
  /// the place of the limb's surface that is nearest to it, `place_m` in the limb's frame. That
  /// place keeps its height and angle: by them alone the distance does not change.
  void Slopes(int limb, const Eigen::Vector3d& place_m, const Eigen::Vector3d& normal,
              Eigen::Ref<Eigen::VectorXd> slopes) const;

 private:
  const ShapeParameters& parameters_;
  std::vector<body_model::BodyModel> models_;  ///< The first one without a step.
  body_model::Kinematics body_;
  std::vector<body_model::Kinematics> changed_;
};

/// Squared errors, in their variances, that are to become smallest: distances of the points from
/// their limbs' surfaces (robust), poses from where they began, parameters from their prior. Frame
/// by frame.
class ShapeProblem {
 public:
  /// All must outlive it.
  ShapeProblem(const ShapeParameters& parameters, const std::vector<ShapeFrame>& frames,
               const ShapeConfig& config);

  const ShapeParameters& parameters() const { return parameters_; }
  std::size_t frame_count() const { return frames_.size(); }
  /// Of the shape's prior.
  double Cost(const Eigen::VectorXd& values) const;
  /// Of one frame in this pose; `kinematics` is moved to it.
  double Cost(std::size_t frame, const body_model::BodyPose& pose,
              body_model::Kinematics& kinematics) const;
  /// Of one frame in this pose; `bodies` are moved to it.
  FrameEquations Equations(std::size_t frame, const body_model::BodyPose& pose,
                           ShapeBodies& bodies) const;
  /// Information of the shape by its prior alone, and the right-hand side of its step.
  std::pair<Eigen::MatrixXd, Eigen::VectorXd> Prior(const Eigen::VectorXd& values) const;
  /// Adds to them what a frame says when its pose is free.
  static void AddReduced(const FrameEquations& frame, double damping, Eigen::MatrixXd& matrix,
                         Eigen::VectorXd& vector);
  /// The pose that follows when the shape has taken its step.
  static body_model::BodyPose Stepped(const body_model::BodyPose& pose, const FrameEquations& frame,
                                      const Eigen::VectorXd& shape_step, double damping);

 private:
  const ShapeParameters& parameters_;
  const std::vector<ShapeFrame>& frames_;
  const ShapeConfig& config_;
  Eigen::Index poses_, shapes_;
  Eigen::VectorXd pose_information_, shape_information_;
};

}  // namespace deixis::pose_fitter
