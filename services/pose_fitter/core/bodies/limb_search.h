#pragma once
#include <optional>
#include <vector>

#include "services/pose_fitter/core/bodies/hypothesis.h"
#include "services/pose_fitter/core/bodies/limb_poses.h"
#include "services/pose_fitter/core/bodies/loose_ends.h"
#include "services/pose_fitter/core/fitting/body_evidence.h"
#include "services/pose_fitter/core/fitting/body_fitter.h"

namespace deixis::pose_fitter {

struct LimbSearchConfig {
  double period_s = 0.1;    ///< Between two searches.
  double better = 0.03;     ///< By which another place must be better.
  double cue_share = 0.03;  ///< Of the score, for each recognised hand or face that is elsewhere.
  double strain_share = 0.005;  ///< Of the score, for an angle at the end of its range.
  double cue_m = 0.08;  ///< A hand recognised farther from the body's tells of another place.
  int points = 500;     ///< By which places are compared,
  int iterations = 5;   ///< and rounds;
  int tried = 3;        ///< the best are then fitted as the whole body is.
  LooseEndsConfig loose;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("period_s", period_s);
    v("better", better);
    v("cue_share", cue_share);
    v("strain_share", strain_share);
    v("cue_m", cue_m);
    v("points", points);
    v("iterations", iterations);
    v("tried", tried);
    v("loose", loose);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// Looks for arms and legs where they may be when they are not where the body has them: not seen
/// there, seen through, something unexplained hanging on the body, or their hands recognised
/// elsewhere. Fits follow what is near; a limb that left it does not come back by itself.
class LimbSearch {
 public:
  /// `model` must outlive it.
  LimbSearch(const LimbSearchConfig& config, const BodyEvidenceConfig& evidence,
             const BodyFitterConfig& fit, const body_model::BodyModel& model);

  /// The body with a limb in a place that explains the image better than `now`, if there is one;
  /// one limb at a time, `seconds` after the last call. `evidence`: that of `now`. A search takes
  /// two calls: the first finds a few places, the next one fits them.
  std::optional<Hypothesis> Find(const BodyEvidence& evidence,
                                 const std::optional<body_model::Floor>& floor,
                                 const ImageContext& context, double seconds,
                                 const Hypothesis& now);

 private:
  bool FindPlaces(const BodyEvidence& evidence, const std::optional<body_model::Floor>& floor,
                  const ImageContext& context, const ChainLimbs& limbs, const Hypothesis& now);
  bool IsDoubtful(const Hypothesis& now, const ChainLimbs& limbs) const;
  bool AddHands(const std::vector<PartCue>& cues, const ChainLimbs& limbs, const Hypothesis& now);
  bool AddLooseEnds(const BodyEvidence& evidence, const ImageContext& context,
                    const ChainLimbs& limbs, const Hypothesis& now);
  void Add(std::vector<body_model::BodyPose> poses);
  void Gather(const DepthView& view, const std::optional<body_model::Floor>& floor,
              const ImageContext& context, const Hypothesis& now, BodyEvidence& around);
  void Shortlist(const std::optional<body_model::Floor>& floor);
  std::optional<Hypothesis> BestOf(const std::optional<body_model::Floor>& floor,
                                   const Hypothesis& now);
  std::optional<Hypothesis> Decide(const BodyEvidence& evidence,
                                   const std::optional<body_model::Floor>& floor,
                                   const ImageContext& context, const Hypothesis& now);
  Hypothesis Fitted(const std::optional<body_model::Floor>& floor, const Hypothesis& now,
                    const body_model::BodyPose& place);
  double ScoreOf(const FitResult& result, const body_model::BodyPose& pose) const;
  double Strain(const body_model::BodyPose& pose) const;

  LimbSearchConfig config_;
  const body_model::BodyModel* model_;
  body_model::Kinematics kinematics_;
  BodyFitter quick_, whole_;
  BodyEvidence few_, around_;
  double gate_m_;
  LooseEnds loose_;
  std::vector<ChainLimbs> chains_;
  body_model::BodyPose rest_;
  std::size_t next_ = 0;  ///< Of chains_.
  double since_s_ = 0.0;
  std::vector<body_model::BodyPose> places_;
};

}  // namespace deixis::pose_fitter
