#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace deixis::range_of_motion {

struct LimbShare {
  std::string limb;    ///< Without its side.
  double share = 1.0;  ///< Of the joint's range that the limb's own envelope has.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("limb", limb);
    v("share", share);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

struct AnglePlan {
  std::string name;
  std::vector<double> axis;  ///< x, y or z of the neutral limb, or its opposite.
  std::string positive;      ///< Motion of joint_limits.yaml with positive angles.
  std::string negative;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("name", name);
    v("axis", axis);
    v("positive", positive);
    v("negative", negative);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

struct KnotPlan {
  std::string motion;           ///< Whose row says how far; empty = `degrees` does.
  std::vector<double> towards;  ///< In the parent's frame; made perpendicular to neutral_z.
  double degrees = 0.0;
  std::string why;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("motion", motion);
    v("towards", towards);
    v("degrees", degrees);
    v("why", why);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

struct ReachPlan {
  std::vector<double> rest_z;  ///< Middle of the cone, in the parent's frame.
  std::vector<KnotPlan> knots;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("rest_z", rest_z);
    v("knots", knots);
  }
};

/// What the default limits allow beyond a row.
struct AllowancePlan {
  std::string motion;
  double degrees = 0.0;
  std::string why;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("motion", motion);
    v("degrees", degrees);
    v("why", why);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

struct JointPlan {
  std::string joint;  ///< Key in joint_limits.yaml.
  std::vector<LimbShare> limbs;
  std::vector<double> neutral_z, neutral_x;
  ReachPlan reach;  ///< No knots: all is said by `angles`.
  std::vector<AnglePlan> angles;
  std::vector<AllowancePlan> allowed_beyond;
  /// While it is bent less, degrees, its last angle and that of the joint above turn the limb about
  /// nearly one axis, and are bounded by their sum only; 0 = never.
  double shares_rotation_below_deg = 0.0;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("joint", joint);
    v("limbs", limbs);
    v("neutral_z", neutral_z);
    v("neutral_x", neutral_x);
    v("reach", reach);
    v("angles", angles);
    v("allowed_beyond", allowed_beyond);
    v("shares_rotation_below_deg", shares_rotation_below_deg);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// A file of config/kinematics: how joints move, and which limits hold.
struct RangePlan {
  std::vector<JointPlan> joints;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("joints", joints);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// Reads config/kinematics/range_of_motion.yaml. Throws ConfigError naming file, line and key.
RangePlan LoadRangePlan(const std::filesystem::path& path);

}  // namespace deixis::range_of_motion
