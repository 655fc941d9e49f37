#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "common/body_model/tracked_body.h"
#include "services/pose_fitter/core/bodies/hypothesis.h"
#include "services/pose_fitter/core/fitting/body_evidence.h"
#include "services/pose_fitter/core/fitting/body_fitter.h"
#include "services/pose_fitter/core/people/people_finder.h"
#include "services/pose_fitter/core/start/effort.h"
#include "services/pose_fitter/core/start/head_tops.h"

namespace deixis::pose_fitter {

struct StarterConfig {
  int effort = 60000;           ///< Of one image: points times rounds of fits, about.
  int coarse_points = 600;      ///< That each start pose is tried with,
  int coarse_iterations = 8;    ///< in so many rounds;
  int kept = 3;                 ///< so many go on, that face the camera, and as many that do not.
  int iterations = 8;           ///< Of the first fit of each of these.
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
  double better_body = 0.02;    ///< By which a less likely body must be better.
  double least_trunk = 0.5;     ///< Share of trunk and head that must be seen.
  double facing_away = 0.04;    ///< Added to the score of who turns the back: robots are looked at.
  HeadTopsConfig heads;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("effort", effort);
    v("coarse_points", coarse_points);
    v("coarse_iterations", coarse_iterations);
    v("kept", kept);
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
    v("better_body", better_body);
    v("least_trunk", least_trunk);
    v("facing_away", facing_away);
    v("heads", heads);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// Whether somebody's body is there, whose head is above it: then what looks like another head is a
/// knee, a fist, or what he holds. `up`: against gravity.
bool IsBelowHead(const Eigen::Vector3d& point_m, const Eigen::Vector3d& head_m,
                 const Eigen::Vector3d& up);

/// Takes out those that are worse than they may be.
void DropNobodies(std::vector<Hypothesis>& starts);

/// Whom a search is for: somebody new, who has a head, or other poses of somebody who is known to
/// be there, and whose head may not be told just now.
enum class Sought { kSomebodyNew, kOtherPoses };

/// What a pose that turns the back to the camera has added to its score.
double FacingPenalty(const StarterConfig& config, const body_model::BodyPose& pose);

/// Finds poses of people of whom nothing but a region of the depth image is known, by articulated
/// fits: others want a pose to start from. All start poses are tried with few points; the better
/// ones go on. A search may take several images, each with as much work as it is allowed.
class Starter {
 public:
  Starter(const StarterConfig& config, const BodyEvidenceConfig& evidence,
          const BodyFitterConfig& fit);

  /// Begins to search the region for a body; a search that was under way is given up.
  void Begin(const DepthView& view, const PeopleRegions& regions, const PersonRegion& region,
             const body_model::BodyModel& model, Sought sought = Sought::kSomebodyNew);
  /// Goes on in this or a later image. `regions` are those of the image.
  void Advance(const DepthView& view, const PeopleRegions& regions, Effort& effort);
  bool IsBusy() const { return next_ < guesses_.size(); }
  /// What a search that is over has found: the best pose that faces the camera and the best one
  /// that does not, as far as they may be; two at most. DropNobodies takes out the bad ones.
  std::vector<Hypothesis> TakeFound();

  /// The same poses in another body, with the head where it was; as far as they are good.
  std::vector<Hypothesis> Wear(const DepthView& view, const PeopleRegions& regions,
                               const std::vector<Hypothesis>& starts,
                               const body_model::BodyModel& before,
                               const body_model::BodyModel& model);

  /// The same in one image.
  std::vector<Hypothesis> Find(const DepthView& view, const PeopleRegions& regions,
                               const PersonRegion& region, const body_model::BodyModel& model);

 private:
  struct Guess {
    body_model::BodyPose pose;
    int place = 0;  ///< Those with the same head have the same one.
    double score = 0.0;
  };
  void TryCoarse(const DepthView& view, const std::optional<body_model::Floor>& floor, Guess& guess,
                 Effort& effort);
  void KeepBest();
  void Refine(const DepthView& view, const PeopleRegions& regions,
              const body_model::BodyPose& guess, Effort& effort);
  std::optional<Hypothesis> Try(const DepthView& view, const PeopleRegions& regions,
                                const body_model::BodyPose& guess, Effort& effort);
  bool Faces(const body_model::BodyPose& pose) const;
  std::vector<Eigen::Vector3d> TopsOf(const DepthView& view, const PeopleRegions& regions,
                                      const PersonRegion& region) const;
  std::vector<Eigen::Vector3d> AllTopsOf(const DepthView& view, const PeopleRegions& regions,
                                         const PersonRegion& region) const;
  double WorstScore(const DepthView& view, const std::vector<HeadShape>& heads, double trunk_seen);
  void SetModel(const body_model::BodyModel& model);

  StarterConfig config_;
  double gate_m_;
  BodyFitterConfig coarse_fit_, first_fit_, second_fit_;
  std::unique_ptr<body_model::BodyModel> model_;  ///< What is searched for.
  std::optional<BodyFitter> coarse_, first_, second_;
  BodyEvidence coarse_evidence_, evidence_;
  int gathered_place_ = -1;  ///< Of the coarse evidence of this image; -1 = none yet.
  bool is_refining_ = false;
  Sought sought_ = Sought::kSomebodyNew;
  std::vector<Guess> guesses_;
  std::size_t next_ = 0;
  std::optional<Hypothesis> facing_, turned_;  ///< The best ones so far.
};

}  // namespace deixis::pose_fitter
