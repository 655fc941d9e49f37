#pragma once
#include <array>
#include <vector>

namespace deixis::pose_fitter {

/// One limb for PCL: points of its surface and those that were measured of it, x y z each, metres.
struct PclLimb {
  std::vector<float> surface_m;
  std::vector<float> measured_m;
};

/// pcl::IterativeClosestPoint of each limb on its own, so many iterations. Returns for each the
/// motion of its surface onto what was measured: a 4 x 4 matrix row by row. This header knows no
/// PCL, whose Eigen is built for plain x86-64.
std::vector<std::array<float, 16>> FitLimbsByPcl(const std::vector<PclLimb>& limbs, int iterations);

}  // namespace deixis::pose_fitter
