#pragma once
#include <cstdint>
#include <vector>

#include "services/pose_fitter/core/depth/depth_view.h"

namespace deixis::pose_fitter {

/// The usual way with PCL: pass-through by range, voxel grid of 2 cm, floor by RANSAC, statistical
/// outlier removal (k = 20), Euclidean clusters. Returns the voxels of all clusters of a person's
/// size, x y z each, in metres. This header knows no PCL, whose Eigen is built for plain x86-64.
std::vector<float> FindPeopleByPcl(const DepthView& depth, double far_m);

}  // namespace deixis::pose_fitter
