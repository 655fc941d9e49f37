#include "services/pose_fitter/core/shape/shape_calibration.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/config/config.h"
#include "services/pose_fitter/core/shape/shape_problem.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kConverged = 1e-4;  // Of the cost.
constexpr double kFirstDamping = 1e-3, kLeastDamping = 1e-6, kMostDamping = 1e4;
constexpr double kValueStep = 1e-4;

void Require(const ShapeParameters& parameters, const std::vector<ShapeFrame>& frames) {
  for (const ShapeFrame& frame : frames) {
    if (frame.pose.angles_rad.size() != parameters.model().angle_count()) {
      throw std::logic_error("CalibrateShape: a pose is not the model's");
    }
    for (const ShapePoint& point : frame.points) {
      if (point.limb < 0 || point.limb >= parameters.model().limb_count()) {
        throw std::logic_error("CalibrateShape: a limb is not the model's");
      }
    }
  }
}

std::size_t PointCount(const std::vector<ShapeFrame>& frames) {
  std::size_t count = 0;
  for (const ShapeFrame& frame : frames) count += frame.points.size();
  return count;
}

/// The next better state, if there is one; `damping` follows Levenberg and Marquardt.
std::optional<ShapeState> Better(const ShapeProblem& problem, const ShapeState& state, double cost,
                                 double& damping) {
  const auto equations = problem.Equations(state);
  for (; damping < kMostDamping; damping *= 10.0) {
    ShapeState next = problem.Stepped(state, equations, damping);
    if (problem.Cost(next) >= cost) continue;
    damping = std::max(0.1 * damping, kLeastDamping);
    return next;
  }
  return std::nullopt;
}

ShapeState Minimise(const ShapeProblem& problem, int max_iterations) {
  ShapeState state = problem.Start();
  double cost = problem.Cost(state), damping = kFirstDamping;
  for (int i = 0; i < max_iterations; ++i) {
    auto next = Better(problem, state, cost, damping);
    if (!next) break;
    state = std::move(*next);
    const double gain = cost - problem.Cost(state);
    cost -= gain;
    if (gain < kConverged * cost) break;
  }
  return state;
}

/// Lengths of limbs, of pairs the right one.
void SetLengths(const ShapeParameters& parameters, CalibratedShape& shape) {
  const std::string kLeft = "left_", kRight = "right_";
  std::vector<std::size_t> limbs;
  for (std::size_t i = 0; i < shape.model.limbs().size(); ++i) {
    const std::string& name = shape.model.limbs()[i].name;
    if (name.rfind(kLeft, 0) == 0) continue;
    limbs.push_back(i);
    shape.lengths.push_back(name.rfind(kRight, 0) == 0 ? name.substr(kRight.size()) : name);
  }
  const auto lengths_m = [&limbs](const BodyModel& model) {
    VectorXd all(static_cast<Eigen::Index>(limbs.size()));
    for (std::size_t i = 0; i < limbs.size(); ++i) {
      all[static_cast<Eigen::Index>(i)] = model.limbs()[limbs[i]].shape.length_m;
    }
    return all;
  };
  shape.lengths_m = lengths_m(shape.model);
  MatrixXd slopes(shape.lengths_m.size(), parameters.count());
  for (Eigen::Index k = 0; k < slopes.cols(); ++k) {
    const VectorXd moved = shape.values + kValueStep * VectorXd::Unit(slopes.cols(), k);
    slopes.col(k) = (lengths_m(parameters.Apply(moved)) - shape.lengths_m) / kValueStep;
  }
  shape.length_covariance_m2 = slopes * shape.covariance * slopes.transpose();
}

bool HasLearned(const ShapeParameters& parameters, const CalibratedShape& shape,
                double max_remaining_sigma) {
  for (int i = 0; i < parameters.count(); ++i) {
    const double prior = parameters.all()[static_cast<std::size_t>(i)].sigma;
    if (std::sqrt(shape.covariance(i, i)) < max_remaining_sigma * prior) return true;
  }
  return false;
}

}  // namespace

void ShapeConfig::Validate() const {
  config::Faults faults;
  faults.Require(min_frames >= 1, "min_frames", "must be at least 1");
  faults.Require(min_points >= 1, "min_points", "must be at least 1");
  faults.Require(lateral_sigma_m > 0.0, "lateral_sigma_m", "must be positive");
  faults.Require(points_per_observation >= 1.0, "points_per_observation", "must be at least 1");
  faults.Require(robust_sigmas > 0.0, "robust_sigmas", "must be positive");
  faults.Require(pose_sigma_rad > 0.0, "pose_sigma_rad", "must be positive");
  faults.Require(root_sigma_m > 0.0, "root_sigma_m", "must be positive");
  faults.Require(max_remaining_sigma > 0.0 && max_remaining_sigma <= 1.0, "max_remaining_sigma",
                 "must lie in 0..1, above 0");
  faults.Require(max_iterations >= 1, "max_iterations", "must be at least 1");
  faults.ThrowIfAny();
}

ShapeResult CalibrateShape(const ShapeParameters& parameters, const std::vector<ShapeFrame>& frames,
                           const ShapeConfig& config) {
  config.Validate();
  Require(parameters, frames);
  if (frames.size() < static_cast<std::size_t>(config.min_frames)) {
    return {std::nullopt, ShapeRefusal::kTooFewFrames};
  }
  if (PointCount(frames) < static_cast<std::size_t>(config.min_points)) {
    return {std::nullopt, ShapeRefusal::kTooFewPoints};
  }
  const ShapeProblem problem(parameters, frames, config);
  ShapeState state = Minimise(problem, config.max_iterations);
  const MatrixXd information = problem.Reduced(problem.Equations(state), state.values, 0.0).first;
  const MatrixXd covariance =
      information.ldlt().solve(MatrixXd::Identity(information.rows(), information.cols()));
  CalibratedShape shape{parameters.Apply(state.values), state.values, covariance, {}, {}, {},
                        std::move(state.poses),         0.0};
  shape.rms_sigmas = problem.Rms({shape.values, shape.poses});
  SetLengths(parameters, shape);
  if (!HasLearned(parameters, shape, config.max_remaining_sigma)) {
    return {std::nullopt, ShapeRefusal::kNothingLearned};
  }
  return {std::move(shape), std::nullopt};
}

}  // namespace deixis::pose_fitter
