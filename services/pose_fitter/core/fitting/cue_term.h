#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "common/body_model/kinematics.h"
#include "services/pose_fitter/core/cues/part_cue.h"
#include "services/pose_fitter/core/fitting/limb_equations.h"

namespace deixis::pose_fitter {

struct CueConfig {
  double hand_weight = 1.0;     ///< Of a hand's cue: this many independent points.
  double face_weight = 2.0;     ///< Of a face's.
  double body_sigma_m = 0.025;  ///< Spread of the part's middle on the body, one sigma.
  double most_m = 0.10;         ///< A cue farther from its part than this pulls less and less.
  double side_cost = 0.05;      ///< Of a hand that is taken for the other side's, at most.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("hand_weight", hand_weight);
    v("face_weight", face_weight);
    v("body_sigma_m", body_sigma_m);
    v("most_m", most_m);
    v("side_cost", side_cost);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// Pulls hands and head to where they were recognised in the colour picture.
class CueTerm {
 public:
  CueTerm(const CueConfig& config, const body_model::BodyModel& model);

  /// Adds the pulls of the cues, each times `weight`.
  void AddTo(const std::vector<PartCue>& cues, const body_model::Kinematics& kinematics,
             double weight, LimbEquations& equations);
  /// How badly the cues agree with the body: 0..1 for each hand and face.
  double Cost(const std::vector<PartCue>& cues, const body_model::Kinematics& kinematics);
  /// Cue that each hand goes with, right and left; -1 = none. Of the last AddTo or Cost.
  const std::array<int, 2>& cue_of_hand() const { return cue_of_hand_; }

 private:
  struct BodyPart {
    int limb = -1;                                      ///< -1 = the model has none.
    Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  ///< In the limb's frame.
  };
  Eigen::Vector3d Place(const BodyPart& part, const body_model::Kinematics& kinematics) const;
  double Cost(const PartCue& cue, const Eigen::Vector3d& place_m) const;
  double HandCost(const PartCue& cue, int side, const body_model::Kinematics& kinematics) const;
  double AssignHands(const std::vector<PartCue>& cues, const body_model::Kinematics& kinematics);
  void Pull(const PartCue& cue, const BodyPart& part, const body_model::Kinematics& kinematics,
            double weight, LimbEquations& equations) const;

  CueConfig config_;
  std::array<BodyPart, 2> hands_;  ///< Right, left.
  BodyPart face_;
  std::array<int, 2> cue_of_hand_{-1, -1};
};

}  // namespace deixis::pose_fitter
