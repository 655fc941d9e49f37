#include "test/benchmark/pose_fitter/pcl_people.h"

#include <pcl/filters/extract_indices.h>
#include <pcl/filters/passthrough.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <limits>

namespace deixis::pose_fitter {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

Cloud::Ptr CloudOf(const DepthView& depth) {
  Cloud::Ptr cloud(new Cloud);
  cloud->is_dense = false;
  cloud->reserve(depth.z_m().size());
  for (int v = 0; v < depth.height_px(); ++v) {
    for (int u = 0; u < depth.width_px(); ++u) {
      if (depth.z_m(u, v) <= 0.0F) continue;
      const Eigen::Vector3f point = depth.Point(u, v).cast<float>();
      cloud->emplace_back(point.x(), point.y(), point.z());
    }
  }
  return cloud;
}

Cloud::Ptr Thinned(const Cloud::Ptr& cloud, double far_m) {
  Cloud::Ptr near(new Cloud), thin(new Cloud);
  pcl::PassThrough<pcl::PointXYZ> range;
  range.setInputCloud(cloud);
  range.setFilterFieldName("z");
  range.setFilterLimits(0.4F, static_cast<float>(far_m));
  range.filter(*near);
  pcl::VoxelGrid<pcl::PointXYZ> voxels;
  voxels.setInputCloud(near);
  voxels.setLeafSize(0.02F, 0.02F, 0.02F);
  voxels.filter(*thin);
  return thin;
}

Cloud::Ptr WithoutFloor(const Cloud::Ptr& cloud) {
  pcl::SACSegmentation<pcl::PointXYZ> plane;
  plane.setModelType(pcl::SACMODEL_PERPENDICULAR_PLANE);
  plane.setAxis(Eigen::Vector3f(0.0F, -1.0F, 0.0F));
  plane.setEpsAngle(0.6);
  plane.setMethodType(pcl::SAC_RANSAC);
  plane.setDistanceThreshold(0.03);
  plane.setMaxIterations(100);
  plane.setInputCloud(cloud);
  pcl::PointIndices::Ptr on_floor(new pcl::PointIndices);
  pcl::ModelCoefficients coefficients;
  plane.segment(*on_floor, coefficients);
  pcl::ExtractIndices<pcl::PointXYZ> extract;
  extract.setInputCloud(cloud);
  extract.setIndices(on_floor);
  extract.setNegative(true);
  Cloud::Ptr rest(new Cloud);
  extract.filter(*rest);
  return rest;
}

Cloud::Ptr WithoutOutliers(const Cloud::Ptr& cloud) {
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> outliers;
  outliers.setInputCloud(cloud);
  outliers.setMeanK(20);
  outliers.setStddevMulThresh(1.5);
  Cloud::Ptr rest(new Cloud);
  outliers.filter(*rest);
  return rest;
}

std::vector<pcl::PointIndices> Clusters(const Cloud::Ptr& cloud) {
  pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>);
  tree->setInputCloud(cloud);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> clusters;
  clusters.setClusterTolerance(0.06);
  clusters.setMinClusterSize(100);
  clusters.setMaxClusterSize(8000);
  clusters.setSearchMethod(tree);
  clusters.setInputCloud(cloud);
  std::vector<pcl::PointIndices> found;
  clusters.extract(found);
  return found;
}

}  // namespace

std::vector<float> FindPeopleByPcl(const DepthView& depth, double far_m) {
  const Cloud::Ptr cloud = WithoutOutliers(WithoutFloor(Thinned(CloudOf(depth), far_m)));
  std::vector<float> points;
  for (const pcl::PointIndices& cluster : Clusters(cloud)) {
    for (const int i : cluster.indices) {
      const pcl::PointXYZ& point = (*cloud)[static_cast<std::size_t>(i)];
      points.insert(points.end(), {point.x, point.y, point.z});
    }
  }
  return points;
}

}  // namespace deixis::pose_fitter
