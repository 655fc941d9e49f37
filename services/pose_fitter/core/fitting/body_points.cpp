#include "services/pose_fitter/core/fitting/body_points.h"

#include <algorithm>

namespace deixis::pose_fitter {

void BodyPoints::Clear() {
  for (auto* values : {&x_m, &y_m, &z_m, &sigma_z_m}) values->clear();
  blocks.clear();
  first_of_block_ = 0;
}

void BodyPoints::Reserve(int points) {
  for (auto* values : {&x_m, &y_m, &z_m, &sigma_z_m}) {
    values->reserve(static_cast<std::size_t>(points));
  }
  blocks.reserve(static_cast<std::size_t>(points));
}

void BodyPoints::Add(const Eigen::Vector3f& point_m, float sigma_z) {
  x_m.push_back(point_m.x());
  y_m.push_back(point_m.y());
  z_m.push_back(point_m.z());
  sigma_z_m.push_back(sigma_z);
  if (count() - first_of_block_ == kBlock) EndBlock();
}

void BodyPoints::EndBlock() {
  PointBlock block{first_of_block_, count() - first_of_block_};
  if (block.count == 0) return;
  Eigen::Array3f low = Eigen::Array3f::Constant(1e9F);
  Eigen::Array3f high = -low;
  for (int i = first_of_block_; i < count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Eigen::Array3f point(x_m[k], y_m[k], z_m[k]);
    low = low.min(point);
    high = high.max(point);
  }
  block.centre_m = 0.5F * (low + high);
  block.radius_m = 0.5F * (high - low).matrix().norm();
  blocks.push_back(block);
  first_of_block_ = count();
}

}  // namespace deixis::pose_fitter
