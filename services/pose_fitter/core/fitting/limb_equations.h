#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/body_model/kinematics.h"
#include "services/pose_fitter/core/fitting/ray_kernels.h"

namespace deixis::pose_fitter {

/// Normal equations by root translation (3, metres), root rotation (3, a rotation vector in the
/// frame, radians) and angles (radians), in the order of body_model::PointJacobian:
/// information * step = pull.
struct BodyEquations {
  Eigen::MatrixXd information;
  Eigen::VectorXd pull;

  void SetZero(int parameters);
};

/// What pulls each limb as a rigid body: six numbers per limb, moments about the root and forces,
/// so that a point costs the same however many joints lie between it and the root.
class LimbEquations {
 public:
  explicit LimbEquations(int limb_count);

  /// Empties it; `root_m` is the root's origin, about which moments are taken.
  void SetZero(const Eigen::Vector3d& root_m);
  /// `point_m` on a limb wants to move by `distance_m` along `direction`, with this weight.
  void Pull(int limb, const Eigen::Vector3d& point_m, const Eigen::Vector3d& direction,
            double distance_m, double weight);
  /// What a kernel summed for a limb, times `weight`.
  void Add(int limb, const LimbSums& sums, double weight);

  const Eigen::Vector3d& root_m() const { return root_m_; }
  const Eigen::Matrix<double, 6, 6>& information(int limb) const {
    return information_[static_cast<std::size_t>(limb)];
  }

  /// Adds what all limbs ask for to the equations of the whole body. Composite inertias run up the
  /// tree, then each joint looks at what hangs on it (Featherstone 2008, composite rigid bodies).
  void AddTo(const body_model::Kinematics& kinematics, BodyEquations& equations);

 private:
  void Accumulate(const body_model::BodyModel& model);
  void FindMotions(const body_model::Kinematics& kinematics);

  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Eigen::Vector3d root_m_ = Eigen::Vector3d::Zero();
  std::vector<Matrix6> information_, composite_information_;
  std::vector<Vector6> pull_, composite_pull_;
  Eigen::Matrix<double, 6, Eigen::Dynamic> motions_;  ///< Of each parameter.
  std::vector<int> moved_;                            ///< Limb that each parameter moves first.
};

}  // namespace deixis::pose_fitter
