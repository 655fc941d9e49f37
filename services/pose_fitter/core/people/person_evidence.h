#pragma once
#include <vector>

#include "services/pose_fitter/core/depth/depth_view.h"
#include "services/pose_fitter/core/people/surface_pieces.h"
#include "services/pose_fitter/core/people/surface_runs.h"

namespace deixis::pose_fitter {

/// What tells people from furniture of their size. Shares are of the pixels.
struct PersonEvidence {
  double round_share = 0.0;     ///< In rows that bulge as trunk and limbs do.
  double straight_share = 0.0;  ///< In rows that are straight, as boards and boxes are.
  double broken_share = 0.0;    ///< In rows too short to be a limb: leaves.
  double head_width_m = 0.0;    ///< Mean width of the highest 20 cm.
  double hanging_share = 0.0;  ///< Of the lowest part: nothing stands below it but what is farther.
  double wide_share = 0.0;     ///< In rows as wide as trunks, or wider.
  double runs_per_row = 0.0;  ///< Limbs break a row into few pieces, leaves and table legs do more.
  bool is_cut_above = false;  ///< By the upper border of the picture,
  bool is_cut_below = false;  ///< or the lower one.
};

/// How much it speaks for a person who looks so: 0 not at all, 1 nothing against it. `top_m`:
/// height of the highest part above the ground.
double LikenessOf(const PersonEvidence& evidence, const SurfaceShape& shape, double top_m);

/// Evidence about groups of pieces. Takes its memory once.
class PersonEvidences {
 public:
  PersonEvidences();
  /// `group_of_piece`: -1 = nobody's. `shapes`: of the groups.
  void Gather(const DepthView& depth, const RoomFrame& room, const SurfaceRuns& runs,
              const std::vector<int>& group_of_piece, const std::vector<SurfaceShape>& shapes);
  const PersonEvidence& of(int group) const { return evidences_[static_cast<std::size_t>(group)]; }

 private:
  /// Of one group, so far.
  struct Sums {
    double pixels = 0.0;
    double lowest_pixels = 0.0;   ///< Of the lowest part,
    double hanging_pixels = 0.0;  ///< and of these the ones that hang.
    int runs = 0;
    int rows = 0;
    int last_row_px = -1;
  };
  static void Add(const DepthView& depth, const RoomFrame& room, const SurfaceShape& shape,
                  const SurfaceRun& run, PersonEvidence& evidence, Sums& sums);
  static void Divide(const Sums& sums, PersonEvidence& evidence);

  std::vector<PersonEvidence> evidences_;
  std::vector<Sums> sums_;
};

}  // namespace deixis::pose_fitter
