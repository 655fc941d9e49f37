#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/body_model/body_model.h"
#include "common/body_model/kinematics.h"
#include "services/pose_fitter/core/fitting/body_evidence.h"
#include "services/pose_fitter/core/fitting/cue_term.h"
#include "services/pose_fitter/core/fitting/limb_equations.h"
#include "services/pose_fitter/core/fitting/outline_term.h"
#include "services/pose_fitter/core/fitting/pose_method.h"

namespace deixis::pose_fitter {

/// How freely the joint of a limb moves.
struct JointFreedom {
  std::string limb;         ///< Name without its side.
  double motion_rad = 0.2;  ///< Change that a thirtieth of a second brings beside the prediction.
  double rest_rad = 10.0;   ///< Spread about the upright stance; 10 = none to speak of.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("limb", limb);
    v("motion_rad", motion_rad);
    v("rest_rad", rest_rad);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

struct BodyFitterConfig {
  int iterations = 12;            ///< Of each fit.
  double first_scale_m = 0.10;    ///< Of the robust weights, in the first round ...
  double last_scale_m = 0.03;     ///< ... and in the last.
  double judged_scale_m = 0.02;   ///< By which a fit is judged against others.
  double first_reach_m = 0.25;    ///< Points farther from all limbs do not count, in the first ...
  double last_reach_m = 0.10;     ///< ... and in the last round.
  double across_m = 0.012;        ///< Spread of clothes about their cylinders, one sigma.
  double point_weight = 0.05;     ///< Of a point: neighbours' errors are much the same.
  double counted_points = 1000;   ///< More points than these count as so many.
  double root_motion_m = 0.04;    ///< As JointFreedom::motion_rad, of the base limb.
  double root_motion_rad = 0.12;  ///< Likewise.
  double motion_weight = 0.4;     ///< Of the prediction.
  double most_rest_rad = 10.0;    ///< Rest spreads of joints are no larger.
  double upright_rad = 10.0;      ///< Spread of the base limb about the vertical; 10 = none.
  double limit_rad = 0.03;        ///< Spread of angles beyond their limits.
  OutlineConfig outline;
  CueConfig cues;
  std::vector<JointFreedom> joints{
      {"abdomen", 0.06, 0.20},  {"chest", 0.06, 0.20},    {"neck", 0.10, 0.25},
      {"head", 0.12, 0.40},     {"clavicle", 0.08, 0.15}, {"upper_arm", 0.22, 2.0},
      {"lower_arm", 0.22, 2.0}, {"hand", 0.20, 0.30},     {"thigh", 0.12, 1.0},
      {"shank", 0.15, 1.5},     {"foot", 0.12, 0.25}};

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("iterations", iterations);
    v("first_scale_m", first_scale_m);
    v("last_scale_m", last_scale_m);
    v("judged_scale_m", judged_scale_m);
    v("first_reach_m", first_reach_m);
    v("last_reach_m", last_reach_m);
    v("across_m", across_m);
    v("point_weight", point_weight);
    v("counted_points", counted_points);
    v("root_motion_m", root_motion_m);
    v("root_motion_rad", root_motion_rad);
    v("motion_weight", motion_weight);
    v("most_rest_rad", most_rest_rad);
    v("upright_rad", upright_rad);
    v("limit_rad", limit_rad);
    v("outline", outline);
    v("cues", cues);
    v("joints", joints);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// A rod of one radius with round ends that holds a limb, in the camera's frame.
struct LimbCapsule {
  Eigen::Vector3f begin_m = Eigen::Vector3f::Zero();
  Eigen::Vector3f along_m = Eigen::Vector3f::UnitZ();  ///< To its other end.
  float inverse_length2 = 1.0F;
  float radius_m = 0.0F;

  float Distance_m(const Eigen::Vector3f& point_m) const;  ///< Negative inside.
};

/// Fits a body to the evidence of one depth image by damped Gauss-Newton steps over root and joint
/// angles, which keep the parts connected by construction. Takes its memory once per number of
/// points.
class BodyFitter final : public PoseMethod {
 public:
  BodyFitter(const BodyFitterConfig& config, const body_model::BodyModel& model);

  const FitResult& Fit(const BodyEvidence& evidence, const std::optional<body_model::Floor>& floor,
                       const body_model::BodyPose& predicted, std::optional<double> seconds,
                       body_model::BodyPose& pose) override;

  /// How well a pose explains the evidence as it is. Holds until the next fit.
  const FitResult& Judge(const BodyEvidence& evidence, const body_model::BodyPose& pose);

  body_model::Kinematics& kinematics() { return kinematics_; }
  const Eigen::MatrixXd& information() const override { return equations_.information; }
  const std::vector<int>& winners() const override { return winners_; }

 private:
  void PlaceLimbs();
  void Assign(const BodyPoints& points, double reach_m);
  void AssignBlock(const BodyPoints& points, const PointBlock& block, float reach_m);
  void SortByLimb(const BodyPoints& points);
  void AddPoints(double scale_m);
  void AddPriors(const body_model::BodyPose& pose, const body_model::BodyPose& predicted,
                 std::optional<double> seconds);
  void AddLimits(const body_model::BodyPose& pose);
  void AddUpright(const body_model::BodyPose& pose, const std::optional<body_model::Floor>& floor);
  void AddFloor(const std::optional<body_model::Floor>& floor);
  void Step(body_model::BodyPose& pose);
  void Judge(const BodyEvidence& evidence);

  BodyFitterConfig config_;
  const body_model::BodyModel* model_;
  body_model::Kinematics kinematics_;
  body_model::BodyPose rest_;
  std::vector<JointFreedom> freedoms_;  ///< Of each limb.
  std::vector<int> trunk_;
  OutlineTerm outline_;
  CueTerm cues_;
  LimbEquations limb_equations_;
  BodyEquations equations_;
  Eigen::LDLT<Eigen::MatrixXd> factors_;
  Eigen::VectorXd step_;
  std::vector<LimbSurface> surfaces_;
  std::vector<LimbCapsule> capsules_;        ///< Around each limb.
  std::vector<std::pair<float, int>> near_;  ///< Limbs near a block: how far, which.
  std::vector<float> scores2_;               ///< Of each point, squared.
  std::vector<int> winners_;
  BodyPoints sorted_;
  std::vector<int> first_of_limb_;  ///< Among sorted_.
  std::vector<int> next_of_limb_;   ///< Likewise, while sorting.
  std::vector<LimbSums> sums_;
  FitResult result_;
};

}  // namespace deixis::pose_fitter
