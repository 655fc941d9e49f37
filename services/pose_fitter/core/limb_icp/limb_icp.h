#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "services/pose_fitter/core/fitting/pose_method.h"
#include "services/pose_fitter/core/limb_icp/limb_matches.h"

namespace deixis::pose_fitter {

struct LimbIcpConfig {
  int iterations = 15;           ///< Cycles at most.
  double reach_m = 0.10;         ///< Points farther from all limbs do not count.
  double equal_m = 0.001;        ///< Distances that differ by less are equal.
  double least_change_m = 5e-4;  ///< A cycle that moves no end of a limb further is the last.
  int least_points = 12;         ///< A limb with fewer goes with its parent.
  double connected_m = 0.05;     ///< A limb that leaves its joint by more keeps its angles.
  double judged_scale_m = 0.02;  ///< By which a fit is judged against others.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("iterations", iterations);
    v("reach_m", reach_m);
    v("equal_m", equal_m);
    v("least_change_m", least_change_m);
    v("least_points", least_points);
    v("connected_m", connected_m);
    v("judged_scale_m", judged_scale_m);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// Fits each limb on its own by closest points, then connects the limbs ("Description of 3D pose
/// estimation at UniKarl", in "Report on definitions of human attribute model and posture
/// estimation"): each point belongs to its nearest limb, or to all in equal distance, far ones to
/// none; each limb is moved onto its points by the rotation and translation of least squares;
/// limbs are put back on their joints; and again, until hardly anything moves. It starts from the
/// pose that it is given, and knows neither spreads nor free space.
class LimbIcp final : public PoseMethod {
 public:
  LimbIcp(const LimbIcpConfig& config, const body_model::BodyModel& model);

  /// `predicted` and `seconds` tell it nothing.
  const FitResult& Fit(const BodyEvidence& evidence, const std::optional<body_model::Floor>& floor,
                       const body_model::BodyPose& predicted, std::optional<double> seconds,
                       body_model::BodyPose& pose) override;
  /// By points alone: the result has neither views of limbs nor a score.
  const FitResult& Fit(const BodyPoints& points, body_model::BodyPose& pose);

  const Eigen::MatrixXd& information() const override { return information_; }
  const std::vector<int>& winners() const override { return matches_.winners(); }
  int cycles() const { return cycles_; }  ///< Of the last fit.

 private:
  double MoveLimbs(body_model::BodyPose& pose);
  void MoveAlone();
  void Connect(int limb, body_model::BodyPose& pose);
  Eigen::Matrix3d TwistedForChild(int limb, const Eigen::Matrix3d& frame_from_limb) const;
  Eigen::Vector3d Shift_m() const;
  double Change_m() const;
  void Describe();

  LimbIcpConfig config_;
  const body_model::BodyModel* model_;
  body_model::Kinematics kinematics_;
  LimbMatches matches_;
  OutlineTerm outline_;
  std::vector<int> trunk_;
  std::vector<Eigen::Isometry3d> alone_;   ///< camera_from_limb, each by its own points.
  std::vector<Eigen::Isometry3d> placed_;  ///< camera_from_limb, connected.
  Eigen::MatrixXd information_;            ///< 0 x 0.
  FitResult result_;
  int cycles_ = 0;
};

}  // namespace deixis::pose_fitter
