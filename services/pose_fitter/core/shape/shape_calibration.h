#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/body_model/body_model.h"
#include "services/pose_fitter/core/shape/shape_parameters.h"

namespace deixis::pose_fitter {

struct FrameEquations;
class ShapeBodies;
class ShapeProblem;

struct ShapeConfig {
  int min_frames = 20;             ///< Fewer frames are refused.
  int min_points = 4000;           ///< Of all frames together; fewer are refused.
  double lateral_sigma_m = 0.006;  ///< Error of a point across its viewing ray.
  /// Errors of neighbouring points go together, and limbs are no cylinders: so many count as one.
  double points_per_observation = 30.0;
  double robust_sigmas = 2.5;   ///< Errors beyond count less and less (Geman and McClure).
  double pose_sigma_rad = 0.3;  ///< How far an angle may be off; holds what nothing shows.
  double root_sigma_m = 0.3;
  /// Of some length the standard deviation must become smaller than this share of its prior's, or
  /// nothing was learned.
  double max_remaining_sigma = 0.7;
  int max_iterations = 12;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("min_frames", min_frames);
    v("min_points", min_points);
    v("lateral_sigma_m", lateral_sigma_m);
    v("points_per_observation", points_per_observation);
    v("robust_sigmas", robust_sigmas);
    v("pose_sigma_rad", pose_sigma_rad);
    v("root_sigma_m", root_sigma_m);
    v("max_remaining_sigma", max_remaining_sigma);
    v("max_iterations", max_iterations);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// A point of the person's surface in the camera frame, which is that of poses too.
struct ShapePoint {
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  double sigma_m = 0.0;  ///< Along its viewing ray; positive.
  int limb = 0;          ///< Index in the model.
};

/// One well observed frame.
struct ShapeFrame {
  body_model::BodyPose pose;  ///< About right: it is refined with the shape.
  std::vector<ShapePoint> points;
};

/// Why there is no shape.
enum class ShapeRefusal { kTooFewFrames, kTooFewPoints, kNothingLearned };

struct CalibratedShape {
  body_model::BodyModel model;
  Eigen::VectorXd values;            ///< Of the parameters.
  Eigen::MatrixXd covariance;        ///< Theirs.
  std::vector<std::string> lengths;  ///< Limbs, without their side, whose lengths follow.
  Eigen::VectorXd lengths_m;
  Eigen::MatrixXd length_covariance_m2;
  std::vector<body_model::BodyPose> poses;  ///< Refined, one per frame.
  double rms_sigmas = 0.0;  ///< Of the points' errors, in their standard deviations; about 1.
};

struct ShapeResult {
  std::optional<CalibratedShape> shape;
  std::optional<ShapeRefusal> refusal;  ///< Of the two exactly one.
};

/// The shape of one person from several frames: shape and all poses together by Gauss-Newton, each
/// frame's pose eliminated from the normal equations (Schur complement), as in bundle adjustment.
/// What the points do not show stays as the prior has it. Which limb a point belongs to depends on
/// the shape: giving the points anew and calibrating again makes lengths better. In small parts, so
/// that nobody waits for it; the result does not depend on the parts.
class ShapeCalibration {
 public:
  /// Throws std::logic_error when a pose or limb is not the model's.
  ShapeCalibration(ShapeParameters parameters, std::vector<ShapeFrame> frames,
                   const ShapeConfig& config);
  ~ShapeCalibration();

  /// Does the work of this many frames in one of the parts of an iteration.
  void Advance(int frames);
  bool IsOver() const { return result_.has_value(); }
  /// Once it is over.
  const ShapeResult& result() const { return *result_; }

 private:
  enum class Part { kFirstCost, kEquations, kReduction, kStep };
  void DoFrame();
  void EndPart();
  void BeginPart(Part part);
  void Judge();
  void Conclude();

  struct State;  ///< A shape with all poses.
  ShapeParameters parameters_;
  std::vector<ShapeFrame> frames_;
  ShapeConfig config_;
  std::unique_ptr<ShapeProblem> problem_;
  std::unique_ptr<State> state_, next_;
  Part part_ = Part::kFirstCost;
  std::size_t frame_ = 0;
  int iteration_ = 0;
  bool is_last_ = false;  ///< Only what the result rests on is still to be had.
  double cost_ = 0.0, next_cost_ = 0.0, damping_ = 0.0;
  std::unique_ptr<ShapeBodies> bodies_;
  std::vector<FrameEquations> equations_;
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd vector_, shape_step_;
  std::optional<ShapeResult> result_;
};

/// The same at once.
ShapeResult CalibrateShape(const ShapeParameters& parameters, const std::vector<ShapeFrame>& frames,
                           const ShapeConfig& config);

}  // namespace deixis::pose_fitter
