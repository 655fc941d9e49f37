#pragma once
#include <Eigen/Core>

namespace deixis::geometry {

/// The solid of one limb: a "degenerate cylinder" between two parallel ellipses of the same
/// rotation, closed by both elliptic discs ("Report on definitions of human attribute model and
/// posture estimation", section 1.1). In the limb's frame the proximal ellipse lies at z = 0, the
/// distal one at z = length, semi-axes a along x and b along y. Surface of the side, for an angle
/// phi and a share s of the length: p(phi, s) = centre(s) + (a(s) cos phi, b(s) sin phi), z = s
/// length, where centre, a and b change linearly. Beyond the report, the ellipses' centres may lie
/// beside the z axis, the bone.
struct DegenerateCylinder {
  double a0_m = 0.0;      ///< Semi-axis of the proximal ellipse along x; positive.
  double b0_m = 0.0;      ///< Along y; positive.
  double a1_m = 0.0;      ///< Semi-axis of the distal ellipse along x; positive.
  double b1_m = 0.0;      ///< Along y; positive.
  double length_m = 0.0;  ///< Distance of the ellipses along z; positive.
  Eigen::Vector2d centre0_m = Eigen::Vector2d::Zero();  ///< Of the proximal ellipse.
  Eigen::Vector2d centre1_m = Eigen::Vector2d::Zero();  ///< Of the distal ellipse.
};

/// Which part of the surface a point lies on.
enum class CylinderPart { kSide, kProximalDisc, kDistalDisc };

/// The point of the surface that is nearest to another point, all in the limb's frame, metres.
struct ClosestPoint {
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  /// Unit gradient of the signed distance: outward; on the surface its normal (at an edge the
  /// side's), elsewhere along the line to `point_m`.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double signed_distance_m = 0.0;  ///< Negative inside.
  CylinderPart part = CylinderPart::kSide;
};

/// Of the side, at the angle phi, radians, and the share s of the length, 0..1.
Eigen::Vector3d SidePoint(const DegenerateCylinder& cylinder, double phi_rad, double s);

/// Outward unit normal of the side there.
Eigen::Vector3d SideNormal(const DegenerateCylinder& cylinder, double phi_rad, double s);

/// True inside and on the surface.
bool IsInside(const DegenerateCylinder& cylinder, const Eigen::Vector3d& point_m);

/// Exact for every point and shape, to rounding: beside, beyond the ends, over a disc, inside, on
/// the axis (where several points are equally near it takes one, always the same). Some 0.5 us;
/// for many points see closest_points.h.
ClosestPoint FindClosest(const DegenerateCylinder& cylinder, const Eigen::Vector3d& point_m);

}  // namespace deixis::geometry
