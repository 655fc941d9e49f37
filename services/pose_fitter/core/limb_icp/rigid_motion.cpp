#include "services/pose_fitter/core/limb_icp/rigid_motion.h"

#include <Eigen/SVD>

namespace deixis::pose_fitter {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLeastWidth = 1e-3;  // Second to first singular value; less is a line.

Matrix3d RotationOf(const Matrix3d& covariance) {
  const Eigen::JacobiSVD<Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (svd.singularValues()[1] <= kLeastWidth * svd.singularValues()[0]) return Matrix3d::Identity();
  Vector3d signs = Vector3d::Ones();
  signs.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace

void PairSums::Add(const Vector3d& from, const Vector3d& to) {
  ++count;
  from_m += from;
  to_m += to;
  to_from_m2.noalias() += to * from.transpose();
  squared_m2 += (to - from).squaredNorm();
}

Eigen::Isometry3d RigidMotion(const PairSums& sums) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  if (sums.count == 0) return motion;
  const Vector3d from_m = sums.from_m / sums.count, to_m = sums.to_m / sums.count;
  if (sums.count >= 3) {
    motion.linear() = RotationOf(sums.to_from_m2 - sums.count * to_m * from_m.transpose());
  }
  motion.translation() = to_m - motion.linear() * from_m;
  return motion;
}

}  // namespace deixis::pose_fitter
