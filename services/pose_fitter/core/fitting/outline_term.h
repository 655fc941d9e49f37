#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/body_model/kinematics.h"
#include "services/pose_fitter/core/fitting/body_evidence.h"
#include "services/pose_fitter/core/fitting/limb_equations.h"

namespace deixis::pose_fitter {

struct OutlineConfig {
  double outline_weight = 0.2;     ///< Of surface that lies before the background.
  double outline_sigma_m = 0.015;  ///< Its spread, across the view.
  double free_weight = 0.2;        ///< Of surface that lies before the measured body.
  double free_sigma_m = 0.03;      ///< Its spread.
  double free_margin_m = 0.04;     ///< Less is not counted, beside the noise of the depth.
  double most_m = 0.15;            ///< Larger distances pull no further.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("outline_weight", outline_weight);
    v("outline_sigma_m", outline_sigma_m);
    v("free_weight", free_weight);
    v("free_sigma_m", free_sigma_m);
    v("free_margin_m", free_margin_m);
    v("most_m", most_m);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// How a depth image sees samples of one limb's surface that face the camera.
struct LimbView {
  int samples = 0;  ///< That face the camera.
  int outside = 0;  ///< Beside the image.
  int hidden = 0;   ///< Behind something nearer.
  int seen = 0;     ///< Where depth is measured at about their distance.
  int free = 0;     ///< Where the camera sees through them.
};

/// Pulls limbs out of space that the camera saw to be empty: surface before the background moves
/// across the image to where the body may be, surface before the measured body moves back.
class OutlineTerm {
 public:
  OutlineTerm(const OutlineConfig& config, const body_model::BodyModel& model);

  /// Adds its pulls, each times `weight`; returns its cost.
  double AddTo(const BodyEvidence& evidence, const body_model::Kinematics& kinematics,
               double weight, LimbEquations& equations) const;
  LimbView Look(const BodyEvidence& evidence, const body_model::Kinematics& kinematics,
                int limb) const;

 private:
  struct Sample {
    int limb = 0;
    Eigen::Vector3d point_m;
    Eigen::Vector3d normal;
  };
  OutlineConfig config_;
  std::vector<Sample> samples_;
  std::vector<int> first_of_limb_;
};

}  // namespace deixis::pose_fitter
