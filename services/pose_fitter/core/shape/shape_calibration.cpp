#include "services/pose_fitter/core/shape/shape_calibration.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

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

struct ShapeCalibration::State {
  VectorXd values;
  std::vector<body_model::BodyPose> poses;
  std::unique_ptr<BodyModel> model;  ///< Of these values.
  std::unique_ptr<body_model::Kinematics> kinematics;

  State(const ShapeParameters& parameters, VectorXd of, std::vector<body_model::BodyPose> in)
      : values(std::move(of)),
        poses(std::move(in)),
        model(std::make_unique<BodyModel>(parameters.Apply(values))),
        kinematics(std::make_unique<body_model::Kinematics>(*model)) {}
};

ShapeCalibration::ShapeCalibration(ShapeParameters parameters, std::vector<ShapeFrame> frames,
                                   const ShapeConfig& config)
    : parameters_(std::move(parameters)), frames_(std::move(frames)), config_(config) {
  config_.Validate();
  Require(parameters_, frames_);
  if (frames_.size() < static_cast<std::size_t>(config_.min_frames)) {
    result_ = {std::nullopt, ShapeRefusal::kTooFewFrames};
  } else if (PointCount(frames_) < static_cast<std::size_t>(config_.min_points)) {
    result_ = {std::nullopt, ShapeRefusal::kTooFewPoints};
  }
  if (result_) return;
  problem_ = std::make_unique<ShapeProblem>(parameters_, frames_, config_);
  std::vector<body_model::BodyPose> poses;
  for (const ShapeFrame& frame : frames_) poses.push_back(frame.pose);
  state_ = std::make_unique<State>(parameters_, VectorXd::Zero(parameters_.count()), poses);
  damping_ = kFirstDamping;
  cost_ = problem_->Cost(state_->values);
}

ShapeCalibration::~ShapeCalibration() = default;

void ShapeCalibration::Advance(int frames) {
  for (; frames > 0 && !IsOver(); --frames) {
    DoFrame();
    if (++frame_ == frames_.size()) EndPart();
  }
}

void ShapeCalibration::DoFrame() {
  switch (part_) {
    case Part::kFirstCost:
      cost_ += problem_->Cost(frame_, state_->poses[frame_], *state_->kinematics);
      break;
    case Part::kEquations:
      equations_.push_back(problem_->Equations(frame_, state_->poses[frame_], *bodies_));
      break;
    case Part::kReduction:
      ShapeProblem::AddReduced(equations_[frame_], damping_, matrix_, vector_);
      break;
    case Part::kStep:
      next_->poses[frame_] =
          ShapeProblem::Stepped(state_->poses[frame_], equations_[frame_], shape_step_, damping_);
      next_cost_ += problem_->Cost(frame_, next_->poses[frame_], *next_->kinematics);
      break;
  }
}

void ShapeCalibration::BeginPart(Part part) {
  part_ = part;
  frame_ = 0;
  if (part == Part::kEquations) {
    equations_.clear();
    bodies_ = std::make_unique<ShapeBodies>(parameters_, state_->values);
  } else if (part == Part::kReduction) {
    std::tie(matrix_, vector_) = problem_->Prior(state_->values);
  } else if (part == Part::kStep) {
    matrix_.diagonal() *= 1.0 + damping_;
    shape_step_ = matrix_.ldlt().solve(vector_);
    next_ = std::make_unique<State>(parameters_, state_->values + shape_step_, state_->poses);
    next_cost_ = problem_->Cost(next_->values);
  }
}

void ShapeCalibration::EndPart() {
  switch (part_) {
    case Part::kFirstCost:
      return BeginPart(Part::kEquations);
    case Part::kEquations:
      if (is_last_) damping_ = 0.0;
      return BeginPart(Part::kReduction);
    case Part::kReduction:
      return is_last_ ? Conclude() : BeginPart(Part::kStep);
    case Part::kStep:
      return Judge();
  }
}

// Damping follows Levenberg and Marquardt.
void ShapeCalibration::Judge() {
  if (next_cost_ < cost_) {
    state_ = std::move(next_);
    is_last_ =
        cost_ - next_cost_ < kConverged * next_cost_ || ++iteration_ == config_.max_iterations;
    cost_ = next_cost_;
    damping_ = std::max(0.1 * damping_, kLeastDamping);
    return BeginPart(Part::kEquations);
  }
  damping_ *= 10.0;
  is_last_ = damping_ >= kMostDamping;
  if (is_last_) damping_ = 0.0;
  BeginPart(Part::kReduction);
}

void ShapeCalibration::Conclude() {
  const MatrixXd covariance =
      matrix_.ldlt().solve(MatrixXd::Identity(matrix_.rows(), matrix_.cols()));
  double squares = 0.0, count = 0.0;
  for (const FrameEquations& frame : equations_) {
    squares += frame.squares;
    count += frame.count;
  }
  CalibratedShape shape{*state_->model,
                        state_->values,
                        covariance,
                        {},
                        {},
                        {},
                        state_->poses,
                        count > 0.0 ? std::sqrt(squares / count) : 0.0};
  SetLengths(parameters_, shape);
  if (HasLearned(parameters_, shape, config_.max_remaining_sigma)) {
    result_ = {std::move(shape), std::nullopt};
  } else {
    result_ = {std::nullopt, ShapeRefusal::kNothingLearned};
  }
}

ShapeResult CalibrateShape(const ShapeParameters& parameters, const std::vector<ShapeFrame>& frames,
                           const ShapeConfig& config) {
  ShapeCalibration calibration(parameters, frames, config);
  while (!calibration.IsOver()) calibration.Advance(1);
  return calibration.result();
}

}  // namespace deixis::pose_fitter
