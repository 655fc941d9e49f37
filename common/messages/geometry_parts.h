#pragma once
// For the .cpp files of this folder only: transforms and lenses inside messages.
#include <cmath>
#include <deixis/camera_calibration_t.hpp>
#include <deixis/transform_t.hpp>

#include "common/geometry/camera_calibration.h"
#include "common/geometry/rigid_transform.h"
#include "common/messages/wire.h"

namespace deixis::messages {

/// How far the length of a quaternion may be from 1: single precision and a few roundings.
inline constexpr double kUnitTolerance = 1e-3;
/// So close to 1 it is left as it is, so that what is sent on has the same bytes.
inline constexpr double kUnitRounding = 1e-14;

/// w x y z, bit for bit; throws Rejected("not_a_rotation") when its length is far from 1.
inline Eigen::Quaterniond ToRotationAsSent(const double (&wxyz)[4]) {
  const auto values = ToVector<4>(wxyz);
  if (!(std::abs(values.norm() - 1.0) <= kUnitTolerance)) throw Rejected("not_a_rotation");
  return {values[0], values[1], values[2], values[3]};
}

/// The same, made of length 1.
inline Eigen::Quaterniond ToRotation(const double (&wxyz)[4]) {
  const Eigen::Quaterniond rotation = ToRotationAsSent(wxyz);
  const double excess = std::abs(rotation.norm() - 1.0);
  return excess <= kUnitRounding ? rotation : rotation.normalized();
}

inline geometry::RigidTransform ToTransform(const double (&translation_m)[3],
                                            const double (&rotation_wxyz)[4]) {
  return {ToRotation(rotation_wxyz), ToVector<3>(translation_m)};
}

inline void FromTransform(const geometry::RigidTransform& transform, double (&translation_m)[3],
                          double (&rotation_wxyz)[4]) {
  const Eigen::Quaterniond& q = transform.rotation;
  FromVector(transform.translation_m, translation_m);
  FromVector(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()), rotation_wxyz);
}

/// Throws Rejected("out_of_range") unless a camera can have that lens (geometry::IsLens) and size.
void RequireSensible(const geometry::CameraCalibration& calibration);

/// A lens as it lies in a message; its sequence number is not looked at.
geometry::CameraCalibration ToCameraCalibration(const camera_calibration_t& message);
camera_calibration_t FromCameraCalibration(const geometry::CameraCalibration& calibration,
                                           std::int64_t sequence);

}  // namespace deixis::messages
