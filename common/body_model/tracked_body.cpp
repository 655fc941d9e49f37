#include "common/body_model/tracked_body.h"

#include <stdexcept>

namespace deixis::body_model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

geometry::RigidTransform Transform(const Eigen::Isometry3d& b_from_a) {
  return {Eigen::Quaterniond(b_from_a.linear()).normalized(), b_from_a.translation()};
}

/// How the uncertainty of root and angles becomes one of points on limbs.
class PointUncertainty {
 public:
  PointUncertainty(const Kinematics& kinematics, const Eigen::MatrixXd& covariance)
      : kinematics_(kinematics),
        covariance_(covariance),
        jacobian_(3, 6 + kinematics.model().angle_count()) {
    if (covariance.size() == 0) return;
    if (covariance.rows() != jacobian_.cols() || covariance.cols() != jacobian_.cols()) {
      throw std::logic_error("PlaceLimbs: the covariance is not of root and angles");
    }
  }

  /// Covariance of a point that is fixed to a limb, square metres.
  Matrix3d Of(int limb, const Vector3d& point_m) {
    if (covariance_.size() == 0) return Matrix3d::Zero();
    PointJacobian(kinematics_, limb, point_m, jacobian_);
    const Matrix3d full = jacobian_ * covariance_ * jacobian_.transpose();
    Matrix3d covariance_m2 = 0.5 * (full + full.transpose());
    // Rounding must not make a variance of zero negative: no receiver would take it.
    covariance_m2.diagonal() = covariance_m2.diagonal().cwiseMax(0.0);
    return covariance_m2;
  }

 private:
  const Kinematics& kinematics_;
  const Eigen::MatrixXd& covariance_;
  Eigen::Matrix3Xd jacobian_;
};

}  // namespace

void PlaceLimbs(Kinematics& kinematics, TrackedBody& body) {
  const BodyModel& model = kinematics.model();
  kinematics.Update(body.pose);
  body.model_id = model.id();
  body.limbs.resize(model.limbs().size());
  PointUncertainty uncertainty(kinematics, body.covariance);
  for (int i = 0; i < model.limb_count(); ++i) {
    LimbPose& limb = body.limbs[static_cast<std::size_t>(i)];
    const int parent = model.limbs()[static_cast<std::size_t>(i)].parent;
    const Eigen::Isometry3d& frame_from_limb = kinematics.limb(i);
    limb.frame_from_limb = Transform(frame_from_limb);
    limb.parent_from_limb = parent < 0
                                ? limb.frame_from_limb
                                : Transform(kinematics.limb(parent).inverse() * frame_from_limb);
    limb.proximal_m = kinematics.proximal_m(i);
    limb.distal_m = kinematics.distal_m(i);
    limb.proximal_covariance_m2 = uncertainty.Of(i, limb.proximal_m);
    limb.distal_covariance_m2 = uncertainty.Of(i, limb.distal_m);
  }
}

}  // namespace deixis::body_model
