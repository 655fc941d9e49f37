#include "test/benchmark/pose_fitter/pcl_icp.h"

#include <pcl/point_types.h>
#include <pcl/registration/icp.h>

namespace deixis::pose_fitter {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

Cloud::Ptr CloudOf(const std::vector<float>& points) {
  Cloud::Ptr cloud(new Cloud);
  cloud->reserve(points.size() / 3);
  for (std::size_t i = 0; i < points.size(); i += 3) {
    cloud->emplace_back(points[i], points[i + 1], points[i + 2]);
  }
  return cloud;
}

}  // namespace

std::vector<std::array<float, 16>> FitLimbsByPcl(const std::vector<PclLimb>& limbs,
                                                 int iterations) {
  std::vector<std::array<float, 16>> motions;
  for (const PclLimb& limb : limbs) {
    Eigen::Matrix4f motion = Eigen::Matrix4f::Identity();
    if (limb.measured_m.size() >= 3 * 12) {
      pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
      icp.setMaximumIterations(iterations);
      icp.setTransformationEpsilon(0.0);
      icp.setEuclideanFitnessEpsilon(0.0);
      icp.setMaxCorrespondenceDistance(0.25);
      icp.setInputSource(CloudOf(limb.measured_m));
      icp.setInputTarget(CloudOf(limb.surface_m));
      Cloud moved;
      icp.align(moved);
      motion = icp.getFinalTransformation().inverse();
    }
    std::array<float, 16>& out = motions.emplace_back();
    for (int i = 0; i < 16; ++i) out[static_cast<std::size_t>(i)] = motion(i / 4, i % 4);
  }
  return motions;
}

}  // namespace deixis::pose_fitter
