#pragma once
#include <string>
#include <vector>

#include "services/pose_fitter/core/fitting/outline_term.h"

namespace deixis::pose_fitter {

/// What one limb rests on.
struct LimbEvidence {
  int inlier_count = 0;
  double residual_m = -1.0;  ///< RMS distance of its points along its normals; -1 = no points.
  LimbView view;             ///< How the depth image sees its surface.
};

struct FitResult {
  double score = 0.0;      ///< Of the whole body: how badly points and free space agree with it.
  double explained = 0.0;  ///< Share of the points that a limb explains.
  double trunk_seen =
      0.0;                ///< Share of the surface of trunk and head that is measured where it is.
  double cue_cost = 0.0;  ///< How badly hands and faces that were recognised agree: 0..1 for each.
  std::vector<LimbEvidence> limbs;
};

/// Name of a limb without its side: right_hand is a hand.
std::string WithoutSide(const std::string& limb);

/// Limbs that are there once: trunk and head.
std::vector<int> TrunkOf(const body_model::BodyModel& model);

/// Scores a body by what its limbs rest on: `explained` of `points` belong to one of them, with
/// this robust cost (0..1 each).
void Score(const std::vector<int>& trunk, int points, int explained, double cost,
           FitResult& result);

}  // namespace deixis::pose_fitter
