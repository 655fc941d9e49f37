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
  Vector3d place_m = Vector3d::Zero();  ///< Limb's frame.
  Vector3d normal = Vector3d::Zero();   ///< Outward, camera frame.
  double distance_m = 0.0;              ///< Signed, of the measured point.
  double variance_m2 = 0.0;             ///< Along the normal.
};

/// Nothing for points that say nothing of the limb: beside its hidden ends, grazing, far off.
std::optional<Contact> ContactOf(const Kinematics& kinematics, const ShapePoint& point,
                                 const ShapeConfig& config) {
  const auto& limb = kinematics.model().limbs()[static_cast<std::size_t>(point.limb)];
  const geometry::ClosestPoint closest =
      geometry::FindClosest(limb.shape, kinematics.limb(point.limb).inverse() * point.point_m);
  const bool has_open_end = kinematics.model().children(point.limb).empty();
  const bool is_open = closest.part == geometry::CylinderPart::kSide ||
                       (has_open_end && closest.part == geometry::CylinderPart::kDistalDisc);
  if (!is_open) return std::nullopt;
  Contact contact;
  contact.place_m = closest.point_m;
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
  const double share = limit / (limit + SquareOf(contact));
  const double robust = share * share;
  return robust / contact.variance_m2 / config.points_per_observation;
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

/// A place of a limb's surface by numbers that mean the same on a limb of another shape.
struct SurfacePlace {
  double height = 0.0;                               ///< Share of the length.
  Eigen::Vector2d beside = Eigen::Vector2d::Zero();  ///< In semi-axes.
};

Eigen::Vector2d CentreAt(const geometry::DegenerateCylinder& shape, double height) {
  return shape.centre0_m + height * (shape.centre1_m - shape.centre0_m);
}

Eigen::Vector2d AxesAt(const geometry::DegenerateCylinder& shape, double height) {
  return {shape.a0_m + height * (shape.a1_m - shape.a0_m),
          shape.b0_m + height * (shape.b1_m - shape.b0_m)};
}

SurfacePlace PlaceOf(const geometry::DegenerateCylinder& shape, const Vector3d& point_m) {
  const double height = point_m.z() / shape.length_m;
  return {height,
          (point_m.head<2>() - CentreAt(shape, height)).cwiseQuotient(AxesAt(shape, height))};
}

Vector3d PointAt(const geometry::DegenerateCylinder& shape, const SurfacePlace& place) {
  Vector3d point_m;
  point_m << CentreAt(shape, place.height) + place.beside.cwiseProduct(AxesAt(shape, place.height)),
      place.height * shape.length_m;
  return point_m;
}

const geometry::DegenerateCylinder& ShapeOf(const Kinematics& kinematics, int limb) {
  return kinematics.model().limbs()[static_cast<std::size_t>(limb)].shape;
}

std::vector<BodyModel> Models(const ShapeParameters& parameters, const VectorXd& values) {
  std::vector<BodyModel> models{parameters.Apply(values)};
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    models.push_back(parameters.Apply(values + kShapeStep * VectorXd::Unit(values.size(), k)));
  }
  return models;
}

}  // namespace

ShapeBodies::ShapeBodies(const ShapeParameters& parameters, const VectorXd& values)
    : parameters_(parameters), models_(Models(parameters, values)), body_(models_.front()) {
  for (std::size_t k = 1; k < models_.size(); ++k) changed_.emplace_back(models_[k]);
}

void ShapeBodies::Update(const BodyPose& pose) {
  body_.Update(pose);
  for (Kinematics& body : changed_) body.Update(pose);
}

void ShapeBodies::Slopes(int limb, const Vector3d& place_m, const Vector3d& normal,
                         Eigen::Ref<VectorXd> slopes) const {
  slopes.setZero();
  const SurfacePlace place = PlaceOf(ShapeOf(body_, limb), place_m);
  const Vector3d at_m = body_.limb(limb) * place_m;
  for (std::size_t k = 0; k < changed_.size(); ++k) {
    if (!parameters_.Changes(static_cast<int>(k), limb)) continue;
    const Vector3d moved_m = changed_[k].limb(limb) * PointAt(ShapeOf(changed_[k], limb), place);
    slopes[static_cast<Eigen::Index>(k)] = -normal.dot(moved_m - at_m) / kShapeStep;
  }
}

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

double ShapeProblem::Cost(const VectorXd& values) const {
  return shape_information_.dot(values.cwiseAbs2());
}

double ShapeProblem::Cost(std::size_t frame, const BodyPose& pose, Kinematics& kinematics) const {
  kinematics.Update(pose);
  const double limit = config_.robust_sigmas * config_.robust_sigmas;
  double points = 0.0;
  for (const ShapePoint& point : frames_[frame].points) {
    const auto contact = ContactOf(kinematics, point, config_);
    // A point that explains nothing costs what robust errors tend to.
    points += contact ? limit * SquareOf(*contact) / (limit + SquareOf(*contact)) : limit;
  }
  const VectorXd off = PoseDifference(frames_[frame].pose, pose);
  return pose_information_.dot(off.cwiseAbs2()) + points / config_.points_per_observation;
}

FrameEquations ShapeProblem::Equations(std::size_t frame, const BodyPose& pose,
                                       ShapeBodies& bodies) const {
  bodies.Update(pose);
  const auto& points = frames_[frame].points;
  FrameEquations equations;
  // Of each point: derivatives by pose and shape, and its error; all times the root of its weight.
  MatrixXd columns(poses_ + shapes_ + 1, static_cast<Eigen::Index>(points.size()));
  Eigen::Matrix3Xd jacobian(3, poses_);
  Eigen::Index used = 0;
  for (const ShapePoint& point : points) {
    const auto contact = ContactOf(bodies.body(), point, config_);
    if (!contact) continue;
    auto column = columns.col(used++);
    const Vector3d touched_m = point.point_m - contact->distance_m * contact->normal;
    body_model::PointJacobian(bodies.body(), point.limb, touched_m, jacobian);
    column.head(poses_).noalias() = -jacobian.transpose() * contact->normal;
    bodies.Slopes(point.limb, contact->place_m, contact->normal, column.segment(poses_, shapes_));
    column[poses_ + shapes_] = contact->distance_m;
    column *= std::sqrt(Weight(*contact, config_));
    equations.squares += SquareOf(*contact);
  }
  equations.count = static_cast<double>(used);
  MatrixXd lower = MatrixXd::Zero(columns.rows(), columns.rows());
  lower.selfadjointView<Eigen::Lower>().rankUpdate(columns.leftCols(used));
  const MatrixXd whole = lower.selfadjointView<Eigen::Lower>();
  equations.pose_pose = whole.topLeftCorner(poses_, poses_);
  equations.pose_pose.diagonal() += pose_information_;
  equations.pose_shape = whole.block(0, poses_, poses_, shapes_);
  equations.shape_shape = whole.block(poses_, poses_, shapes_, shapes_);
  equations.pose = -pose_information_.cwiseProduct(PoseDifference(frames_[frame].pose, pose)) -
                   whole.col(poses_ + shapes_).head(poses_);
  equations.shape = -whole.col(poses_ + shapes_).segment(poses_, shapes_);
  return equations;
}

std::pair<MatrixXd, VectorXd> ShapeProblem::Prior(const VectorXd& values) const {
  return {shape_information_.asDiagonal(), -shape_information_.cwiseProduct(values)};
}

void ShapeProblem::AddReduced(const FrameEquations& frame, double damping, MatrixXd& matrix,
                              VectorXd& vector) {
  const MatrixXd eliminated = Damped(frame, damping).ldlt().solve(frame.pose_shape);
  matrix += frame.shape_shape - frame.pose_shape.transpose() * eliminated;
  vector += frame.shape - eliminated.transpose() * frame.pose;
}

BodyPose ShapeProblem::Stepped(const BodyPose& pose, const FrameEquations& frame,
                               const VectorXd& shape_step, double damping) {
  const VectorXd right = frame.pose - frame.pose_shape * shape_step;
  return Moved(pose, Damped(frame, damping).ldlt().solve(right));
}

}  // namespace deixis::pose_fitter
