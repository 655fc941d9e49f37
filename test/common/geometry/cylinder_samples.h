#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/geometry/degenerate_cylinder.h"

namespace deixis::geometry {

/// Of the sizes that limbs have, some flat, some tapered, some with ellipses beside the bone; some
/// far from any limb. Always the same ones.
std::vector<DegenerateCylinder> RandomCylinders(int count);

/// Inside, near the surface, on the axis, over the discs, beyond the ends and far away.
std::vector<Eigen::Vector3d> RandomPoints(const DegenerateCylinder& cylinder, int count);

/// Shapes of limbs: trunk, head, arm, leg, hand, foot; some with ellipses beside the bone.
std::vector<DegenerateCylinder> BodyLimbs();

/// At most so far from the surface, inside and outside, over the discs as well.
std::vector<Eigen::Vector3d> PointsNear(const DegenerateCylinder& cylinder, double distance_m,
                                        int count);

/// Points of the side and of both discs.
std::vector<Eigen::Vector3d> DenseSurface(const DegenerateCylinder& cylinder, int around,
                                          int along);

}  // namespace deixis::geometry
