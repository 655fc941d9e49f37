#pragma once
#include "common/geometry/degenerate_cylinder.h"

namespace deixis::geometry {

struct DistanceAndNormal {
  double signed_distance_m;
  Eigen::Vector3d normal;
};

/// What FindClosest finds, as one would write it for one point without exactness for every point in
/// mind: Newton's method on the angle from one start, in turns with the best share of the length.
/// Inside, near the medial axis, it may end in the wrong minimum.
DistanceAndNormal FindClosestFromOneStart(const DegenerateCylinder& cylinder,
                                          const Eigen::Vector3d& point_m);

}  // namespace deixis::geometry
