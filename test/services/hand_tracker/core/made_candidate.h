#pragma once
#include "services/hand_tracker/core/hand_candidates.h"

namespace deixis::hand_tracker {

inline constexpr double kMadeHandLength_px = 40.0;

/// A region as large as a hand, `moving_share` of whose pixels changed of late and `fresh_share`
/// since the last image.
inline HandCandidate MadeCandidate(const Eigen::Vector2d& centre, double moving_share,
                                   double fresh_share) {
  HandCandidate candidate;
  candidate.centre = candidate.tip = candidate.root = centre;
  candidate.box = {centre.x() - 10.0, centre.y() - 15.0, 20.0, 30.0};
  candidate.hand_length_px = kMadeHandLength_px;
  candidate.area_px = 0.3 * kMadeHandLength_px * kMadeHandLength_px;
  candidate.region_length_px = kMadeHandLength_px;
  candidate.moving_share = moving_share;
  candidate.fresh_share = fresh_share;
  return candidate;
}

}  // namespace deixis::hand_tracker
