#include "services/anthropometer/core/plane_reach.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <set>

namespace deixis::anthropometer {
namespace {

using body_model::Kinematics;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using range_of_motion::BodySide;
using range_of_motion::ModelJoint;

constexpr double kDegree = M_PI / 180.0;
constexpr double kInPlane = 0.9;  // Of the neutral direction's length.
constexpr double kOffPlane_rad =
    4.0 * kDegree;  // A joint that is further away does not move in the plane.
// A plane may run along a limit, as the sagittal one does from the arm's flexion to straight up: it
// ends where it comes as near as this, which is then added.
constexpr double kNear_rad = 0.25 * kDegree;
constexpr double kLeast_rad = 10.0 * kDegree;  // What moves less moves in another plane.

bool IsAboutLimb(const std::string& motion) {
  static const std::set<std::string> kAboutLimb = {
      "rotation",   "inside_rotation", "outside_rotation", "pronation",
      "supination", "eversion",        "inversion"};
  return kAboutLimb.count(motion) > 0;
}

/// A joint in the plane of a view.
class JointInPlane {
 public:
  JointInPlane(View view, const Kinematics& kinematics, const ModelJoint& joint)
      : joint_(joint.joint),
        right_(kinematics.limb(joint.parent).linear().transpose() * RightIn(view)),
        up_(kinematics.limb(joint.parent).linear().transpose() * Vector3d::UnitZ()),
        neutral_(joint_.Orientation(range_of_motion::AnatomicalAngles::Zero())) {}

  bool IsNeutralInPlane() const {
    return std::hypot(neutral_.col(2).dot(right_), neutral_.col(2).dot(up_)) > kInPlane;
  }
  double neutral_rad() const {
    return std::atan2(neutral_.col(2).dot(up_), neutral_.col(2).dot(right_));
  }

  /// The margin of what is nearest to its limit, there; of motions about the limb none counts.
  range_of_motion::Margin MarginAt(double angle_rad) const {
    const Vector3d there = std::cos(angle_rad) * right_ + std::sin(angle_rad) * up_;
    const auto angles = joint_.Measure(
        Eigen::Quaterniond::FromTwoVectors(neutral_.col(2), there).toRotationMatrix() * neutral_);
    range_of_motion::Margin nearest;
    nearest.margin_rad = std::numeric_limits<double>::infinity();
    const double off_plane = joint_.Orientation(angles).col(2).dot(there);
    if (off_plane < std::cos(kOffPlane_rad)) nearest.margin_rad = -1.0;
    const auto margins = joint_.Check(angles);
    for (int i = 0; i < margins.count; ++i) {
      const auto& margin = margins.each[static_cast<std::size_t>(i)];
      if (margin.motion == nullptr || IsAboutLimb(*margin.motion)) continue;
      if (margin.margin_rad < nearest.margin_rad) nearest = margin;
    }
    return nearest;
  }

  /// By steps of a degree, then by halving. No motion where the joint leaves the plane.
  PlaneBound BoundTowards(double sign) const {
    const auto is_possible = [&](double angle_rad) {
      return MarginAt(neutral_rad() + sign * angle_rad).margin_rad >= kNear_rad;
    };
    double low = 0.0;
    while (low < M_PI && is_possible(low + kDegree)) low += kDegree;
    double high = low + kDegree;
    for (int i = 0; i < 30; ++i) {
      const double middle = 0.5 * (low + high);
      (is_possible(middle) ? low : high) = middle;
    }
    const auto end = MarginAt(neutral_rad() + sign * high);
    return {std::min(low + kNear_rad, M_PI), end.motion == nullptr ? "" : *end.motion};
  }

 private:
  const range_of_motion::AnatomicalJoint& joint_;
  Vector3d right_, up_;  ///< In the frame of the joint's parent.
  Matrix3d neutral_;     ///< parent_from_limb.
};

/// Where the joint turns: on the body's axis where its first limb begins, else its last.
int LimbAt(const body_model::BodyModel& model, const ModelJoint& joint) {
  int limb = joint.limb;
  if (joint.joint.side() != BodySide::kMiddle) return limb;
  while (model.limbs()[static_cast<std::size_t>(limb)].parent != joint.parent) {
    limb = model.limbs()[static_cast<std::size_t>(limb)].parent;
  }
  return limb;
}

}  // namespace

std::vector<PlaneReach> ReachesIn(View view, const Kinematics& kinematics,
                                  const range_of_motion::RangeOfMotion& range) {
  std::vector<PlaneReach> reaches;
  for (const ModelJoint& joint : range.joints()) {
    const JointInPlane in_plane(view, kinematics, joint);
    if (!in_plane.IsNeutralInPlane()) continue;
    const auto& limb = kinematics.model().limbs()[static_cast<std::size_t>(joint.limb)];
    const PlaneReach reach{&joint,
                           kinematics.proximal_m(LimbAt(kinematics.model(), joint)),
                           limb.shape.length_m,
                           in_plane.neutral_rad(),
                           in_plane.BoundTowards(-1.0),
                           in_plane.BoundTowards(1.0)};
    const bool is_in_plane = !reach.clockwise.motion.empty() && !reach.anticlockwise.motion.empty();
    if (is_in_plane && reach.clockwise.angle_rad + reach.anticlockwise.angle_rad > kLeast_rad) {
      reaches.push_back(reach);
    }
  }
  return reaches;
}

}  // namespace deixis::anthropometer
