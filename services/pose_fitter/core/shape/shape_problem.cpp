#include "services/pose_fitter/core/shape/shape_problem.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/geometry/degenerate_cylinder.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;
using body_model::BodyPose;
using body_model::Kinematics;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kShapeStep = 1e-4;    // Of numeric derivatives, by factors and metres alike.
constexpr double kLeastFacing = 0.25;  // Surfaces seen at a smaller cosine say little.
constexpr double kFarthest_sigmas = 6.0;

/// The point of a limb's surface that explains a measured one.
struct Contact {
  Vector3d normal = Vector3d::Zero();  ///< Outward, camera frame.
  double distance_m = 0.0;             ///< Signed, of the measured point.
  double variance_m2 = 0.0;            ///< Along the normal.
};

geometry::ClosestPoint Closest(const Kinematics& kinematics, const ShapePoint& point) {
  const auto& limb = kinematics.model().limbs()[static_cast<std::size_t>(point.limb)];
  return geometry::FindClosest(limb.shape, kinematics.limb(point.limb).inverse() * point.point_m);
}

/// Nothing for points that say nothing of the limb: beside its hidden ends, grazing, far off.
std::optional<Contact> ContactOf(const Kinematics& kinematics, const ShapePoint& point,
                                 const ShapeConfig& config) {
  const geometry::ClosestPoint closest = Closest(kinematics, point);
  const bool has_open_end = kinematics.model().children(point.limb).empty();
  const bool is_open = closest.part == geometry::CylinderPart::kSide ||
                       (has_open_end && closest.part == geometry::CylinderPart::kDistalDisc);
  if (!is_open) return std::nullopt;
  Contact contact;
  contact.normal = kinematics.limb(point.limb).linear() * closest.normal;
  contact.distance_m = closest.signed_distance_m;
  const double facing = -contact.normal.dot(point.point_m.normalized());
  if (facing < kLeastFacing) return std::nullopt;
  contact.variance_m2 = std::pow(facing * point.sigma_m, 2) + std::pow(config.lateral_sigma_m, 2);
  const double farthest_m = kFarthest_sigmas * std::sqrt(contact.variance_m2);
  if (std::abs(contact.distance_m) > std::max(farthest_m, 0.05)) return std::nullopt;
  return contact;
}

double SquareOf(const Contact& contact) {
  return contact.distance_m * contact.distance_m / contact.variance_m2;
}

/// Weight of one point's squared error, 1 / m^2.
double Weight(const Contact& contact, const ShapeConfig& config) {
  const double limit = config.robust_sigmas * config.robust_sigmas;
  const double robust = std::pow(limit / (limit + SquareOf(contact)), 2);
  return robust / contact.variance_m2 / config.points_per_observation;
}

FrameEquations Empty(Eigen::Index poses, Eigen::Index shapes) {
  return {MatrixXd::Zero(poses, poses), MatrixXd::Zero(poses, shapes),
          MatrixXd::Zero(shapes, shapes), VectorXd::Zero(poses), VectorXd::Zero(shapes)};
}

VectorXd PoseDifference(const BodyPose& from, const BodyPose& to) {
  VectorXd difference(6 + to.angles_rad.size());
  difference.head<3>() = to.frame_from_root.translation_m - from.frame_from_root.translation_m;
  const Eigen::AngleAxisd turn(to.frame_from_root.rotation *
                               from.frame_from_root.rotation.conjugate());
  difference.segment<3>(3) = turn.angle() * turn.axis();
  difference.tail(to.angles_rad.size()) = to.angles_rad - from.angles_rad;
  return difference;
}

BodyPose Moved(BodyPose pose, const VectorXd& step) {
  pose.frame_from_root.translation_m += step.head<3>();
  const Eigen::Quaterniond turn(body_model::RotationFrom(step.segment<3>(3)));
  pose.frame_from_root.rotation = (turn * pose.frame_from_root.rotation).normalized();
  pose.angles_rad += step.tail(step.size() - 6);
  return pose;
}

MatrixXd Damped(const FrameEquations& frame, double damping) {
  MatrixXd matrix = frame.pose_pose;
  matrix.diagonal() *= 1.0 + damping;
  return matrix;
}

/// The bodies with one parameter a step on each, posed alike: for numeric derivatives.
class ChangedBodies {
 public:
  ChangedBodies(const std::vector<BodyModel>& models, const BodyPose& pose) {
    for (const BodyModel& model : models) {
      bodies_.emplace_back(model);
      bodies_.back().Update(pose);
    }
  }
  /// Of the point's distance by each parameter.
  void Slopes(const ShapePoint& point, double distance_m, VectorXd& slopes) const {
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      slopes[static_cast<Eigen::Index>(k)] =
          (Closest(bodies_[k], point).signed_distance_m - distance_m) / kShapeStep;
    }
  }

 private:
  std::vector<Kinematics> bodies_;
};

}  // namespace

ShapeProblem::ShapeProblem(const ShapeParameters& parameters, const std::vector<ShapeFrame>& frames,
                           const ShapeConfig& config)
    : parameters_(parameters),
      frames_(frames),
      config_(config),
      poses_(6 + parameters.model().angle_count()),
      shapes_(parameters.count()),
      pose_information_(VectorXd::Constant(poses_, std::pow(config.pose_sigma_rad, -2))),
      shape_information_(shapes_) {
  pose_information_.head<3>().setConstant(std::pow(config.root_sigma_m, -2));
  for (Eigen::Index i = 0; i < shapes_; ++i) {
    shape_information_[i] = std::pow(parameters.all()[static_cast<std::size_t>(i)].sigma, -2);
  }
}

ShapeState ShapeProblem::Start() const {
  ShapeState state{VectorXd::Zero(shapes_), {}};
  for (const ShapeFrame& frame : frames_) state.poses.push_back(frame.pose);
  return state;
}

double ShapeProblem::Cost(const ShapeState& state) const {
  const BodyModel model = parameters_.Apply(state.values);
  Kinematics kinematics(model);
  const double limit = config_.robust_sigmas * config_.robust_sigmas;
  double prior = shape_information_.dot(state.values.cwiseAbs2()), points = 0.0;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    kinematics.Update(state.poses[i]);
    const VectorXd off = PoseDifference(frames_[i].pose, state.poses[i]);
    prior += pose_information_.dot(off.cwiseAbs2());
    for (const ShapePoint& point : frames_[i].points) {
      const auto contact = ContactOf(kinematics, point, config_);
      // A point that explains nothing costs what robust errors tend to.
      points += contact ? limit * SquareOf(*contact) / (limit + SquareOf(*contact)) : limit;
    }
  }
  return prior + points / config_.points_per_observation;
}

FrameEquations ShapeProblem::EquationsOf(const BodyModel& model,
                                         const std::vector<BodyModel>& changed,
                                         const BodyPose& pose, const ShapeFrame& frame) const {
  FrameEquations equations = Empty(poses_, shapes_);
  Kinematics kinematics(model);
  kinematics.Update(pose);
  const ChangedBodies others(changed, pose);
  equations.pose_pose.diagonal() = pose_information_;
  equations.pose = -pose_information_.cwiseProduct(PoseDifference(frame.pose, pose));
  Eigen::Matrix3Xd jacobian(3, poses_);
  VectorXd by_pose(poses_), by_shape(shapes_);
  for (const ShapePoint& point : frame.points) {
    const auto contact = ContactOf(kinematics, point, config_);
    if (!contact) continue;
    const Vector3d touched_m = point.point_m - contact->distance_m * contact->normal;
    body_model::PointJacobian(kinematics, point.limb, touched_m, jacobian);
    by_pose.noalias() = -jacobian.transpose() * contact->normal;
    others.Slopes(point, contact->distance_m, by_shape);
    const double weight = Weight(*contact, config_);
    equations.pose_pose.selfadjointView<Eigen::Lower>().rankUpdate(by_pose, weight);
    equations.pose_shape.noalias() += weight * by_pose * by_shape.transpose();
    equations.shape_shape.noalias() += weight * by_shape * by_shape.transpose();
    equations.pose.noalias() -= weight * contact->distance_m * by_pose;
    equations.shape.noalias() -= weight * contact->distance_m * by_shape;
  }
  const MatrixXd whole = equations.pose_pose.selfadjointView<Eigen::Lower>();
  equations.pose_pose = whole;
  return equations;
}

std::vector<FrameEquations> ShapeProblem::Equations(const ShapeState& state) const {
  const BodyModel model = parameters_.Apply(state.values);
  std::vector<BodyModel> changed;
  for (Eigen::Index k = 0; k < shapes_; ++k) {
    changed.push_back(parameters_.Apply(state.values + kShapeStep * VectorXd::Unit(shapes_, k)));
  }
  std::vector<FrameEquations> all;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    all.push_back(EquationsOf(model, changed, state.poses[i], frames_[i]));
  }
  return all;
}

std::pair<MatrixXd, VectorXd> ShapeProblem::Reduced(const std::vector<FrameEquations>& frames,
                                                    const VectorXd& values, double damping) const {
  MatrixXd matrix = shape_information_.asDiagonal();
  VectorXd vector = -shape_information_.cwiseProduct(values);
  for (const FrameEquations& frame : frames) {
    const MatrixXd eliminated = Damped(frame, damping).ldlt().solve(frame.pose_shape);
    matrix += frame.shape_shape - frame.pose_shape.transpose() * eliminated;
    vector += frame.shape - eliminated.transpose() * frame.pose;
  }
  return {matrix, vector};
}

ShapeState ShapeProblem::Stepped(const ShapeState& state, const std::vector<FrameEquations>& frames,
                                 double damping) const {
  auto [matrix, vector] = Reduced(frames, state.values, damping);
  matrix.diagonal() *= 1.0 + damping;
  const VectorXd shape_step = matrix.ldlt().solve(vector);
  ShapeState next{state.values + shape_step, {}};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const VectorXd right = frames[i].pose - frames[i].pose_shape * shape_step;
    next.poses.push_back(Moved(state.poses[i], Damped(frames[i], damping).ldlt().solve(right)));
  }
  return next;
}

double ShapeProblem::Rms(const ShapeState& state) const {
  const BodyModel model = parameters_.Apply(state.values);
  Kinematics kinematics(model);
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    kinematics.Update(state.poses[i]);
    for (const ShapePoint& point : frames_[i].points) {
      const auto contact = ContactOf(kinematics, point, config_);
      if (!contact) continue;
      sum += SquareOf(*contact);
      count += 1.0;
    }
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

}  // namespace deixis::pose_fitter
