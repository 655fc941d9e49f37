#pragma once
#include <array>
#include <vector>

#include "services/pose_fitter/core/depth/depth_view.h"
#include "services/pose_fitter/core/people/surface_pieces.h"
#include "services/pose_fitter/core/people/surface_runs.h"

namespace deixis::pose_fitter {

/// What tells people from furniture of their size. Shares are of the pixels.
struct PersonEvidence {
  double round_share = 0.0;       ///< In rows that bulge as trunk and limbs do.
  double straight_share = 0.0;    ///< In rows that are straight, as boards and boxes are.
  double broken_share = 0.0;      ///< In rows too short to be a limb: leaves.
  double head_width_m = 0.0;      ///< Mean width of the highest 20 cm
  double shoulder_width_m = 0.0;  ///< and of what lies 30 to 50 cm below the top.
  double hanging_share = 0.0;  ///< Of the lowest part: nothing stands below it but what is farther.
  bool is_cut_above = false;   ///< By the upper border of the picture.
};

/// How much it speaks for a person whose highest part is `top_m` above the floor: 0 not at all, 1
/// nothing against it.
double LikenessOf(const PersonEvidence& evidence, double top_m);

/// Evidence about groups of pieces. Takes its memory once.
class PersonEvidences {
 public:
  PersonEvidences();
  /// `group_of_piece`: -1 = nobody's. `shapes`: of the groups.
  void Gather(const DepthView& depth, const RoomFrame& room, const SurfaceRuns& runs,
              const std::vector<int>& group_of_piece, const std::vector<SurfaceShape>& shapes);
  const PersonEvidence& of(int group) const { return evidences_[static_cast<std::size_t>(group)]; }

 private:
  std::vector<PersonEvidence> evidences_;
  std::vector<std::array<double, 3>> sums_;
};

}  // namespace deixis::pose_fitter
