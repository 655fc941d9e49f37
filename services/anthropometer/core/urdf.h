#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "common/body_model/body_model.h"
#include "services/anthropometer/core/joint_chain.h"

namespace deixis::anthropometer {

/// The body's density for masses in URDF, kg/m3: that of water, which people nearly have.
constexpr double kDensity_kg_per_m3 = 1000.0;

/// Roll, pitch, yaw, radians, of a rotation matrix Rz(yaw) Ry(pitch) Rx(roll), exact at pitches of
/// +-90 degrees too.
Eigen::Vector3d RollPitchYaw(const Eigen::Matrix3d& rotation);

/// A joint of the URDF.
struct UrdfJoint {
  std::string name;
  std::string parent;  ///< Links.
  std::string child;
  int limb = 0;  ///< Of the model, which it moves.
  geometry::RigidTransform parent_from_joint;
  bool is_fixed = false;
  ChainJoint turn;  ///< Unless it is fixed.
};

/// The tree of joints, parents before children. The links are named as REP 155 (ROS4HRI) names
/// them, where it does: a limb by its proximal joint (l_shoulder_<id> = left upper arm), the root
/// body_<id>, which has no shape. Link frames are those of the limbs.
std::vector<UrdfJoint> UrdfJoints(const body_model::BodyModel& model, const std::string& body_id);

/// An angle of a URDF's joint, radians.
struct JointValue {
  std::string joint;
  double angle_rad = 0.0;
};

/// What the joints that are not fixed stand at, so that each link lies as its limb in that pose.
std::vector<JointValue> JointValues(const body_model::BodyModel& model,
                                    const std::vector<UrdfJoint>& joints,
                                    const body_model::BodyPose& pose);

/// The file's text: cylinders of the limbs' volume and length, masses and inertia of the limbs as
/// homogeneous bodies. Throws ConfigError when two limbs would have one name.
std::string UrdfOf(const body_model::BodyModel& model, const std::string& body_id);

}  // namespace deixis::anthropometer
