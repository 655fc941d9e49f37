#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "common/anatomy/joint_limits.h"
#include "common/body_model/body_model.h"
#include "common/body_model/kinematics.h"
#include "common/range_of_motion/anatomical_joint.h"
#include "common/range_of_motion/range_plan.h"

namespace deixis::range_of_motion {

/// An anatomical joint and the limbs of a model that make it together.
struct ModelJoint {
  AnatomicalJoint joint;
  int parent = 0;  ///< Limb that the first one hangs on.
  int limb = 0;    ///< The last one: its orientation in the parent is the joint's.
  /// Index of the joint above that it shares its rotation with while it is bent less than
  /// `shares_below_rad`; -1 = none.
  int shares_with = -1;
  double shares_below_rad = 0.0;

  /// right_hip, left_hip, cervical_spine ...
  std::string Name() const;
};

/// One joint in one pose.
struct JointState {
  AnatomicalAngles angles = AnatomicalAngles::Zero();
  Margins margins;
};

/// Reads config/kinematics/range_of_motion.yaml. Throws ConfigError naming file, line and key, also
/// of a joint that has no row for one of its motions.
RangePlan LoadRangePlan(const std::filesystem::path& path, const anatomy::JointLimits& rows);

/// The anatomical joints of one body model: those of the plan whose limbs it has, found by name.
class RangeOfMotion {
 public:
  /// Throws ConfigError naming the joint as AnatomicalJoint does, and when the limbs of a joint do
  /// not hang on each other.
  RangeOfMotion(const body_model::BodyModel& model, const RangePlan& plan,
                const anatomy::JointLimits& rows, Limits limits = Limits::kDefault);

  const std::vector<ModelJoint>& joints() const { return joints_; }
  /// Its angles in a pose.
  AnatomicalAngles Measure(const body_model::Kinematics& kinematics, const ModelJoint& joint) const;
  /// Angles and margins of all joints in a pose, in their order. Where a joint shares its rotation
  /// with the one above, both have the larger margin of their own and of their sum.
  void Check(const body_model::Kinematics& kinematics, std::vector<JointState>& states,
             Load load = Load::kUnknown) const;

 private:
  void ShareRotation(std::size_t joint, std::vector<JointState>& states, Load load) const;

  std::vector<ModelJoint> joints_;
};

}  // namespace deixis::range_of_motion
