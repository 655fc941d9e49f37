#include "common/range_of_motion/anatomical_joint.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"
#include "common/config/config.h"

namespace deixis::range_of_motion {
namespace {

using body_model::RotationFrom;
using body_model::SwingTo;
using body_model::TwistOf;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kRadiansPerDegree = M_PI / 180.0;
/// A standing person's knee is at its limit of rotation, not beyond it.
constexpr double kRounding_rad = 1e-9;

Vector3d Mirrored(const std::vector<double>& direction, BodySide side) {
  return {direction[0], side == BodySide::kLeft ? -direction[1] : direction[1], direction[2]};
}

/// With columns x, y, z; x made perpendicular to z.
Matrix3d FrameOf(const std::string& joint, const Vector3d& z, const Vector3d& hint) {
  const Vector3d across = hint - hint.dot(z) / z.squaredNorm() * z;
  if (across.norm() < 1e-3) {
    throw config::ConfigError("joint '" + joint + "': neutral_x must not be parallel to neutral_z");
  }
  Matrix3d frame;
  frame.col(2) = z.normalized();
  frame.col(0) = across.normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

double AllowedBeyond(const JointPlan& plan, const std::string& motion, Limits limits) {
  if (limits == Limits::kSource) return 0.0;
  for (const AllowancePlan& allowance : plan.allowed_beyond) {
    if (allowance.motion == motion) return allowance.degrees * kRadiansPerDegree;
  }
  return 0.0;
}

/// Rotation angles about x, y, z of Rx Ry Rz or Ry Rx Rz.
Vector3d CardanAngles(const Matrix3d& r, bool starts_with_y) {
  const auto arcsine = [](double sine) { return std::asin(std::clamp(sine, -1.0, 1.0)); };
  if (starts_with_y) {
    return {arcsine(-r(1, 2)), std::atan2(r(0, 2), r(2, 2)), std::atan2(r(1, 0), r(1, 1))};
  }
  return {std::atan2(-r(1, 2), r(2, 2)), arcsine(r(0, 2)), std::atan2(-r(0, 1), r(0, 0))};
}

Margin MarginOf(const std::array<Bound, 2>& bounds, double angle_rad, double flexion_rad,
                Load load) {
  const double above_rad = bounds[0].At(flexion_rad, load).high_rad;
  const double below_rad = bounds[1].At(flexion_rad, load).high_rad;
  if (above_rad - angle_rad <= below_rad + angle_rad) {
    return {&bounds[0].motion, angle_rad, above_rad, above_rad - angle_rad};
  }
  return {&bounds[1].motion, -angle_rad, below_rad, below_rad + angle_rad};
}

}  // namespace

AnatomicalJoint::AnatomicalJoint(const JointPlan& plan, BodySide side,
                                 const anatomy::JointLimits& rows, Limits limits)
    : joint_(plan.joint), side_(side) {
  parent_from_neutral_ =
      FrameOf(joint_, Mirrored(plan.neutral_z, side), Mirrored(plan.neutral_x, side));
  parent_from_rest_ = parent_from_neutral_;
  const auto bound = [&](const std::string& motion) {
    return BoundOf(rows, joint_, motion, AllowedBeyond(plan, motion, limits));
  };
  if (!plan.reach.knots.empty()) {
    angle_names_ = {"elevation", "plane_of_elevation"};
    std::vector<Bound> by_knot;
    for (const KnotPlan& knot : plan.reach.knots) {
      const double as_given = knot.degrees * kRadiansPerDegree;
      by_knot.push_back(knot.motion.empty() ? Bound{"", {as_given, as_given}, {}, {}}
                                            : bound(knot.motion));
    }
    BuildReach(plan.reach, by_knot);
  }
  for (const AnglePlan& angle : plan.angles) {
    const auto along = std::find_if(angle.axis.begin(), angle.axis.end(),
                                    [](double value) { return value != 0.0; });
    const auto coordinate = static_cast<int>(along - angle.axis.begin());
    // A mirror turns rotations about x and z round, not those about y.
    const double mirror = side == BodySide::kLeft && coordinate != 1 ? -1.0 : 1.0;
    axes_.push_back({coordinate, mirror * *along});
    angle_names_.push_back(angle.name);
    bounds_.push_back({bound(angle.positive), bound(angle.negative)});
  }
}

void AnatomicalJoint::BuildReach(const ReachPlan& plan, const std::vector<Bound>& by_knot) {
  const Vector3d rest = parent_from_neutral_.transpose() * Mirrored(plan.rest_z, side_);
  parent_from_rest_ = parent_from_neutral_ * RotationFrom(SwingTo(rest.normalized()));
  std::vector<ReachCone::Knot> knots;
  for (std::size_t i = 0; i < by_knot.size(); ++i) {
    Vector3d towards = parent_from_neutral_.transpose() * Mirrored(plan.knots[i].towards, side_);
    towards.z() = 0.0;
    if (towards.norm() < 1e-3) {
      throw config::ConfigError("joint '" + joint_ +
                                "': reach.knots: towards must not be parallel to neutral_z");
    }
    towards.normalize();
    const double angle_rad = by_knot[i].straight.high_rad;
    const Vector3d direction =
        std::cos(angle_rad) * Vector3d::UnitZ() + std::sin(angle_rad) * towards;
    knots.push_back(
        {by_knot[i].motion, parent_from_rest_.transpose() * (parent_from_neutral_ * direction)});
  }
  try {
    reach_ = ReachCone(knots);
  } catch (const std::invalid_argument& error) {
    throw config::ConfigError("joint '" + joint_ + "': reach.knots: " + error.what());
  }
}

AnatomicalAngles AnatomicalJoint::Measure(const Matrix3d& parent_from_limb) const {
  AnatomicalAngles angles = AnatomicalAngles::Zero();
  if (!reach_.empty()) {
    const Vector3d z = parent_from_neutral_.transpose() * parent_from_limb.col(2);
    const double outward = side_ == BodySide::kLeft ? -z.y() : z.y();
    angles[0] = std::atan2(std::hypot(z.x(), z.y()), z.z());
    angles[1] = std::atan2(outward, z.x());
    const Matrix3d rest_from_limb = parent_from_rest_.transpose() * parent_from_limb;
    const Matrix3d twist =
        RotationFrom(SwingTo(rest_from_limb.col(2))).transpose() * rest_from_limb;
    if (!axes_.empty()) angles[2] = axes_[0].sign * TwistOf(twist);
    return angles;
  }
  const Vector3d turned =
      CardanAngles(parent_from_neutral_.transpose() * parent_from_limb, axes_[0].coordinate == 1);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    angles[static_cast<Eigen::Index>(i)] = axes_[i].sign * turned[axes_[i].coordinate];
  }
  return angles;
}

Vector3d AnatomicalJoint::DirectionOf(const AnatomicalAngles& angles) const {
  const double outward = side_ == BodySide::kLeft ? -std::sin(angles[1]) : std::sin(angles[1]);
  return {std::sin(angles[0]) * std::cos(angles[1]), std::sin(angles[0]) * outward,
          std::cos(angles[0])};
}

Matrix3d AnatomicalJoint::Orientation(const AnatomicalAngles& angles) const {
  if (!reach_.empty()) {
    const Vector3d in_rest =
        parent_from_rest_.transpose() * (parent_from_neutral_ * DirectionOf(angles));
    const double twist = axes_.empty() ? 0.0 : axes_[0].sign * angles[2];
    return parent_from_rest_ * RotationFrom(SwingTo(in_rest)) *
           RotationFrom(twist * Vector3d::UnitZ());
  }
  Matrix3d rotation = parent_from_neutral_;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double angle = axes_[i].sign * angles[static_cast<Eigen::Index>(i)];
    rotation = rotation * RotationFrom(angle * Vector3d::Unit(axes_[i].coordinate));
  }
  return rotation;
}

double AnatomicalJoint::FlexionOf(const AnatomicalAngles& angles) const {
  return reach_.empty() ? angles[0] : 0.0;
}

bool AnatomicalJoint::HasRotation() const { return !axes_.empty() && axes_.back().coordinate == 2; }

AnatomicalJoint::Rotation AnatomicalJoint::RotationOf(const AnatomicalAngles& angles,
                                                      Load load) const {
  if (bounds_.empty()) return {};
  const auto last = static_cast<Eigen::Index>(angle_names_.size()) - 1;
  const double flexion_rad = FlexionOf(angles);
  return {angles[last], -bounds_.back()[1].At(flexion_rad, load).high_rad,
          bounds_.back()[0].At(flexion_rad, load).high_rad};
}

Margins AnatomicalJoint::Check(const AnatomicalAngles& angles, Load load) const {
  Margins margins;
  const auto add = [&margins](Margin margin) {
    if (std::abs(margin.margin_rad) < kRounding_rad) margin.margin_rad = 0.0;
    margins.each[static_cast<std::size_t>(margins.count++)] = margin;
  };
  if (!reach_.empty()) {
    const ReachCone::Place place =
        reach_.Find(parent_from_rest_.transpose() * (parent_from_neutral_ * DirectionOf(angles)));
    add({&reach_.motion(place.knot), place.angle_rad, place.boundary_rad,
         place.boundary_rad - place.angle_rad});
  }
  const Eigen::Index first = reach_.empty() ? 0 : 2;
  for (std::size_t i = 0; i < bounds_.size(); ++i) {
    add(MarginOf(bounds_[i], angles[first + static_cast<Eigen::Index>(i)], FlexionOf(angles),
                 load));
  }
  return margins;
}

}  // namespace deixis::range_of_motion
