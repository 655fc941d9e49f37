#pragma once
#include <Eigen/Geometry>

namespace deixis::pose_fitter {

/// Sums over pairs of points that belong together, metres.
struct PairSums {
  int count = 0;
  Eigen::Vector3d from_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d to_from_m2 = Eigen::Matrix3d::Zero();  ///< Of to * from'.
  double squared_m2 = 0.0;                               ///< Of the squared distances.

  void Add(const Eigen::Vector3d& from, const Eigen::Vector3d& to);
};

/// The motion that takes `from` to `to` with the least sum of squares (Arun, Huang and Blostein
/// 1987; never a reflection: Umeyama 1991). Points on one line, or fewer than three, tell no
/// rotation: they give a translation. No points give no motion.
Eigen::Isometry3d RigidMotion(const PairSums& sums);

}  // namespace deixis::pose_fitter
