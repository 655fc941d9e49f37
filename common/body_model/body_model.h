#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/config/config.h"
#include "common/geometry/degenerate_cylinder.h"
#include "common/geometry/rigid_transform.h"

namespace deixis::body_model {

/// How an angle turns its limb.
enum class DofKind {
  kHinge,  ///< About `axis`.
  kSwing,  ///< One component of the rotation vector that says where the limb's z axis points.
  kTwist   ///< About the limb's own z axis.
};

/// One rotational degree of freedom of a joint, with the outer envelope of its motion; limits that
/// depend on the posture are narrower.
struct DegreeOfFreedom {
  std::string name;  ///< Anatomical: flexion, abduction, rotation ...
  DofKind kind = DofKind::kHinge;
  /// Unit axis in the limb's rest frame; positive angles turn right-handed about it. Of a swing it
  /// is perpendicular to z, of a twist it is z or -z.
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();
  double angle_min_rad = 0.0;
  double angle_max_rad = 0.0;
  double speed_max_rad_per_s = 0.0;          ///< 0 = no limit known.
  double acceleration_max_rad_per_s2 = 0.0;  ///< 0 = no limit known.
};

/// A degenerate cylinder on a joint. Its frame: origin at the proximal joint, z along the limb
/// towards the distal end. Its orientation in its parent is rest * exp(swing) * hinges *
/// exp(twist), the hinges in their order.
struct Limb {
  std::string name;
  int parent = -1;                          ///< Index in the model; -1 = the base limb.
  geometry::RigidTransform rest_in_parent;  ///< parent_from_limb at zero angles.
  geometry::DegenerateCylinder shape;
  std::vector<DegreeOfFreedom> dofs;  ///< At most three; none = fixed to its parent.
};

/// What is wrong with one limb: "limb 'right_hand': length is ...".
class LimbFault : public config::ConfigError {
 public:
  /// `key` is what files of config/body_models call it; empty = the limb itself.
  LimbFault(std::string limb, std::string key, const std::string& fault);
  const std::string& limb() const { return limb_; }
  const std::string& key() const { return key_; }

 private:
  std::string limb_;
  std::string key_;
};

/// The constant shape of one person: a tree of limbs, parents before their children, the base limb
/// first ("Report on definitions of human attribute model and posture estimation", section 1.2).
class BodyModel {
 public:
  /// No limb is longer or thicker, metres.
  static constexpr double kLargest_m = 3.0;
  static constexpr int kMostLimbs = 1000;

  /// Throws LimbFault, or ConfigError when there are none or too many, when `limbs` are no such
  /// tree, sizes are not positive or absurd, axes do not suit their kinds, a joint mixes swings and
  /// hinges, or a smallest angle is above its largest.
  BodyModel(std::string name, std::vector<Limb> limbs);

  const std::string& name() const { return name_; }
  const std::vector<Limb>& limbs() const { return limbs_; }
  int limb_count() const { return static_cast<int>(limbs_.size()); }
  int angle_count() const { return angle_count_; }
  /// Place of the limb's first angle among all angles.
  int first_angle(int limb) const { return first_angles_[static_cast<std::size_t>(limb)]; }
  /// Indices of the limbs whose parent it is.
  const std::vector<int>& children(int limb) const {
    return children_[static_cast<std::size_t>(limb)];
  }
  std::optional<int> Find(std::string_view limb_name) const;

  /// Equal for equal content, on every machine; never 0.
  std::int64_t id() const { return id_; }

 private:
  std::string name_;
  std::vector<Limb> limbs_;
  std::vector<int> first_angles_;
  std::vector<std::vector<int>> children_;
  int angle_count_ = 0;
  std::int64_t id_ = 0;
};

/// Where a body is.
struct BodyPose {
  geometry::RigidTransform frame_from_root;  ///< Of the base limb.
  Eigen::VectorXd angles_rad;                ///< Limb by limb, in the order of their dofs.
};

/// All angles zero, where the envelope allows it, else at its nearest bound.
BodyPose RestPose(const BodyModel& model);

}  // namespace deixis::body_model
