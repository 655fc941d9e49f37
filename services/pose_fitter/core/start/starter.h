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
  double worst_score = 0.5;     ///< Fits that are worse are nobody;
  double worst_with_head = 0.72;  ///< likewise, with a certain head and trunk.
  double least_head = 0.8;  ///< Likeness of a head that is one; in the picture all people have one.
  double certain_head = 0.9;    ///< Likeness of a head that is certainly one.
  double certain_trunk = 0.75;  ///< Share of trunk and head that is, where depth has little noise.
  double least_trunk = 0.5;     ///< Share of trunk and head that must be seen.
  double facing_away = 0.04;    ///< Added to the score of who turns the back: robots are looked at.
  double better_body = 0.02;    ///< By which a less likely body must be better.
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
    v("worst_with_head", worst_with_head);
    v("least_head", least_head);
    v("certain_head", certain_head);
    v("certain_trunk", certain_trunk);
    v("least_trunk", least_trunk);
    v("facing_away", facing_away);
    v("better_body", better_body);
    v("heads", heads);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// Whether somebody's body is there, whose head is above it: then what looks like another head is a
/// knee, a fist, or what he holds. `up`: against gravity.
bool IsBelowHead(const Eigen::Vector3d& point_m, const Eigen::Vector3d& head_m,
                 const Eigen::Vector3d& up);

/// What a pose that turns the back to the camera has added to its score.
double FacingPenalty(const StarterConfig& config, const body_model::BodyPose& pose);

/// Poses that somebody may have, the better ones first, and the body that they are of.
struct Starts {
  std::vector<Hypothesis> poses;
  std::size_t body = 0;  ///< Its place in those that were given.
};

/// Finds poses of people of whom nothing but a region of the depth image is known, by articulated
/// fits: others want a pose to start from.
class Starter {
 public:
  Starter(const StarterConfig& config, const BodyEvidenceConfig& evidence,
          const BodyFitterConfig& fit);

  /// The best pose that faces the camera and the best one that does not, as far as they are good:
  /// two at most. `gate_m` is that of the evidence of the second fit. `bodies`: those that the
  /// person may have, the likeliest first; poses are looked for with that one, the others are tried
  /// in them.
  Starts Find(const DepthView& view, const PeopleRegions& regions, const PersonRegion& region,
              const std::vector<const body_model::BodyModel*>& bodies);

  /// Other poses of somebody who is known to be there, and whose head may not be told just now.
  std::vector<Hypothesis> FindRivals(const DepthView& view, const PeopleRegions& regions,
                                     const PersonRegion& region,
                                     const body_model::BodyModel& model);

 private:
  std::optional<Hypothesis> Try(const DepthView& view, const PeopleRegions& regions,
                                const body_model::BodyPose& guess);
  std::vector<Hypothesis> FindWith(const DepthView& view, const PeopleRegions& regions,
                                   const std::vector<Eigen::Vector3d>& tops_m,
                                   const body_model::BodyModel& model);
  std::vector<Hypothesis> Wear(const DepthView& view, const PeopleRegions& regions,
                               const std::vector<Hypothesis>& starts,
                               const body_model::BodyModel& before,
                               const body_model::BodyModel& model);
  std::vector<Eigen::Vector3d> TopsOf(const DepthView& view, const PeopleRegions& regions,
                                      const PersonRegion& region) const;
  double WorstScore(const DepthView& view, const std::vector<HeadShape>& heads, double trunk_seen);

  StarterConfig config_;
  double gate_m_;
  BodyFitterConfig first_fit_, second_fit_;
  std::optional<BodyFitter> first_, second_;
  BodyEvidence evidence_;
};

}  // namespace deixis::pose_fitter
