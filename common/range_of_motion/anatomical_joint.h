#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "common/anatomy/joint_limits.h"
#include "common/range_of_motion/bound.h"
#include "common/range_of_motion/range_plan.h"
#include "common/range_of_motion/reach_cone.h"

namespace deixis::range_of_motion {

/// On which side of the body a joint is.
enum class BodySide { kMiddle, kRight, kLeft };

/// Which limits hold.
enum class Limits {
  kSource,  ///< The rows of joint_limits.yaml as they are.
  kDefault  ///< Widened by what healthy people were seen to do: `allowed_beyond`.
};

/// Anatomical angles of one joint, radians, all 0 in the neutral-zero stance: those of its plan in
/// their order. A joint with a reach cone has first the elevation of the limb from neutral, 0..pi,
/// then the plane of elevation: 0 forward, pi/2 away from the body (ISB's names).
using AnatomicalAngles = Eigen::Vector3d;

/// How far one angle is from its limit.
struct Margin {
  const std::string* motion = nullptr;  ///< Key in joint_limits.yaml of the limit that is nearest.
  double angle_rad = 0.0;   ///< In the direction of that motion; of a cone from its rest direction.
  double limit_rad = 0.0;   ///< What is possible there.
  double margin_rad = 0.0;  ///< limit - angle: negative beyond the limit; 0 within rounding.
};

struct Margins {
  std::array<Margin, 3> each;
  int count = 0;
};

/// A joint as anatomy names it, which limbs of a model make together: its angles and limits.
class AnatomicalJoint {
 public:
  /// Throws ConfigError naming the joint when `limits` lacks a row, knots are too far apart, or a
  /// neutral direction is parallel to the other or to the direction of a knot.
  AnatomicalJoint(const JointPlan& plan, BodySide side, const anatomy::JointLimits& rows,
                  Limits limits);

  const std::string& joint() const { return joint_; }  ///< Key in joint_limits.yaml.
  BodySide side() const { return side_; }
  /// What the angles are called: flexion, abduction, rotation ...; elevation, plane of elevation.
  const std::vector<std::string>& angle_names() const { return angle_names_; }
  /// The limits of the angles that `angle_names` names, first the positive one; none for a reach
  /// cone's two.
  const std::vector<std::array<Bound, 2>>& bounds() const { return bounds_; }
  const ReachCone& reach() const { return reach_; }

  /// From the orientation of the joint's last limb in the parent of its first one, a rotation
  /// matrix. Angles that the joint does not have are 0.
  AnatomicalAngles Measure(const Eigen::Matrix3d& parent_from_limb) const;
  /// The orientation with these angles: the inverse of Measure.
  Eigen::Matrix3d Orientation(const AnatomicalAngles& angles) const;
  /// Whether it turns about the limb itself.
  bool HasRotation() const;
  /// The last angle, about the limb itself, and between what it may turn.
  struct Rotation {
    double angle_rad = 0.0, least_rad = 0.0, most_rad = 0.0;
  };
  Rotation RotationOf(const AnatomicalAngles& angles, Load load = Load::kUnknown) const;
  /// One margin per bounded angle, that of the rotation about the limb last; a reach cone has one
  /// for both of its angles.
  Margins Check(const AnatomicalAngles& angles, Load load = Load::kUnknown) const;

 private:
  struct Axis {
    int coordinate = 0;
    double sign = 1.0;
  };
  Eigen::Vector3d DirectionOf(const AnatomicalAngles& angles) const;
  double FlexionOf(const AnatomicalAngles& angles) const;
  void BuildReach(const ReachPlan& plan, const std::vector<Bound>& by_knot);

  std::string joint_;
  BodySide side_;
  std::vector<std::string> angle_names_;
  std::vector<std::array<Bound, 2>> bounds_;
  std::vector<Axis> axes_;
  Eigen::Matrix3d parent_from_neutral_;
  Eigen::Matrix3d parent_from_rest_;  ///< z: the rest direction; of a reach cone only.
  ReachCone reach_;
};

}  // namespace deixis::range_of_motion
