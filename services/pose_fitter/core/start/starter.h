#pragma once
#include <optional>
#include <vector>

#include "common/body_model/tracked_body.h"
#include "services/pose_fitter/core/bodies/hypothesis.h"
#include "services/pose_fitter/core/fitting/body_evidence.h"
#include "services/pose_fitter/core/fitting/body_fitter.h"
#include "services/pose_fitter/core/people/people_finder.h"
#include "services/pose_fitter/core/start/head_tops.h"

namespace deixis::pose_fitter {

struct StarterConfig {
  int iterations = 12;          ///< Of the first fit of each start pose.
  double first_scale_m = 0.1;   ///< Of its robust weights, in the first round.
  double first_reach_m = 0.25;  ///< Points farther from all limbs do not count, in the first round.
  double rest_rad = 0.5;        ///< Spread of all joints about the start pose, in the first fit.
  double upright_rad = 0.25;    ///< Of the base limb about the vertical, likewise.
  double gate_m = 0.2;          ///< Pixels this near to a start pose may belong to the person.
  double worst_score = 0.5;     ///< Fits that are worse are nobody.
  double least_trunk = 0.5;     ///< Share of trunk and head that must be seen.
  double facing_away = 0.04;    ///< Added to the score of who turns the back: robots are looked at.
  HeadTopsConfig heads;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("iterations", iterations);
    v("first_scale_m", first_scale_m);
    v("first_reach_m", first_reach_m);
    v("rest_rad", rest_rad);
    v("upright_rad", upright_rad);
    v("gate_m", gate_m);
    v("worst_score", worst_score);
    v("least_trunk", least_trunk);
    v("facing_away", facing_away);
    v("heads", heads);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// What a pose that turns the back to the camera has added to its score.
double FacingPenalty(const StarterConfig& config, const body_model::BodyPose& pose);

/// Finds poses of people of whom nothing but a region of the depth image is known, by articulated
/// fits: others want a pose to start from.
class Starter {
 public:
  Starter(const StarterConfig& config, const BodyEvidenceConfig& evidence,
          const BodyFitterConfig& fit);

  /// The best pose that faces the camera and the best one that does not, as far as they are good:
  /// two at most. `gate_m` is that of the evidence of the second fit.
  std::vector<Hypothesis> Find(const DepthView& view, const PeopleRegions& regions,
                               const PersonRegion& region, const body_model::BodyModel& model);

 private:
  std::optional<Hypothesis> Try(const DepthView& view,
                                const std::optional<body_model::Floor>& floor,
                                const body_model::BodyPose& guess);

  StarterConfig config_;
  double gate_m_;
  BodyFitterConfig first_fit_, second_fit_;
  std::optional<BodyFitter> first_, second_;
  BodyEvidence evidence_;
};

}  // namespace deixis::pose_fitter
