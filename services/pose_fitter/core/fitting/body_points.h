#pragma once
#include <Eigen/Core>
#include <vector>

namespace deixis::pose_fitter {

/// A run of points that lie close together, and a ball around them.
struct PointBlock {
  int first = 0;
  int count = 0;
  Eigen::Vector3f centre_m = Eigen::Vector3f::Zero();
  float radius_m = 0.0F;
};

/// Measured points of one person, coordinate by coordinate, in the camera's optical frame, in
/// blocks.
struct BodyPoints {
  static constexpr int kBlock = 64;  ///< Points per block at most.

  std::vector<float> x_m, y_m, z_m;
  std::vector<float> sigma_z_m;  ///< Spread of z, one sigma.
  std::vector<PointBlock> blocks;

  int count() const { return static_cast<int>(x_m.size()); }
  void Clear();
  void Reserve(int points);
  void Add(const Eigen::Vector3f& point_m, float sigma_z);
  /// Ends a block at the last point that was added.
  void EndBlock();

 private:
  int first_of_block_ = 0;
};

}  // namespace deixis::pose_fitter
