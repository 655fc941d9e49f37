#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace deixis::geometry {

/// Turns coordinates in one frame into coordinates in another: as `b_from_a`, p_b = rotation * p_a
/// + translation.
struct RigidTransform {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< Of unit length.
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();       ///< Origin of a in b, metres.

  Eigen::Vector3d operator*(const Eigen::Vector3d& point_m) const {
    return rotation * point_m + translation_m;
  }
};

/// c_from_a, of c_from_b and b_from_a.
inline RigidTransform operator*(const RigidTransform& c_from_b, const RigidTransform& b_from_a) {
  return {(c_from_b.rotation * b_from_a.rotation).normalized(), c_from_b * b_from_a.translation_m};
}

/// a_from_b, of b_from_a.
inline RigidTransform Inverse(const RigidTransform& b_from_a) {
  const Eigen::Quaterniond rotation = b_from_a.rotation.conjugate();
  return {rotation, -(rotation * b_from_a.translation_m)};
}

}  // namespace deixis::geometry
