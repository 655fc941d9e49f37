#pragma once
#include <array>

#include "common/config/config.h"
#include "services/hand_tracker/core/hand_candidates.h"

namespace deixis::hand_tracker {

/// Weights of a log-linear density ratio over what is seen of a candidate. Areas in hand lengths
/// squared, lengths in hand lengths, shares 0..1.
struct HandLikelihoodWeights {
  double constant = 0.0;
  double log_area = 0.0;          ///< Per ln(area) ...
  double log_area_squared = 0.0;  ///< ... and per its square.
  double long_region = 0.0;       ///< Per length of its region above 2.
  double far_root = 0.0;        ///< Per distance of the region's root from the shoulder above 3.2.
  double far_centre = 0.0;      ///< Per distance of the centre from the shoulder above 3.6.
  double near_centre = 0.0;     ///< Per distance of the centre from the shoulder below 1.2.
  double at_shoulder = 0.0;     ///< When it may be a sleeve's end.
  double at_face = 0.0;         ///< When it lies beside a face.
  double moving = 0.0;          ///< Per share of pixels that changed of late ...
  double moving_squared = 0.0;  ///< ... and per its square.
  double fresh = 0.0;           ///< Per share of pixels that changed since the last image ...
  double moving_and_fresh = 0.0;  ///< ... and per product of both shares.
  double by_motion_alone = 0.0;   ///< When it is no region's end: it may be a part of an arm.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("constant", constant);
    v("log_area", log_area);
    v("log_area_squared", log_area_squared);
    v("long_region", long_region);
    v("far_root", far_root);
    v("far_centre", far_centre);
    v("near_centre", near_centre);
    v("at_shoulder", at_shoulder);
    v("at_face", at_face);
    v("moving", moving);
    v("moving_squared", moving_squared);
    v("fresh", fresh);
    v("moving_and_fresh", moving_and_fresh);
    v("by_motion_alone", by_motion_alone);
  }
};

struct HandLikelihoodConfig {
  HandLikelihoodWeights resting{-5.63, -3.89, -1.62, -0.26, -1.02, -4.90, -0.81,
                                -2.09, -4.05, 7.10,  -2.13, 4.91,  -4.09, -2.43};
  HandLikelihoodWeights moving{-6.92, -3.86, -1.92, -0.50, 0.03,  -0.38, -1.73,
                               -0.40, -3.94, 7.46,  -6.79, 10.75, -1.79, -2.81};
  double least = -4.0;   ///< One image never says more against a hand, nats ...
  double largest = 6.0;  ///< ... nor for it.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("resting", resting);
    v("moving", moving);
    v("least", least);
    v("largest", largest);
  }
  void Validate() const;
};

/// Log ratio between how often a hand looks like a candidate and how often per image something else
/// does.
struct HandEvidence {
  double resting = 0.0;  ///< For a hand that rests or moves slowly ...
  double moving = 0.0;   ///< ... and for one that moves at more than 3.5 hand lengths/s.
};

HandEvidence Judge(const HandLikelihoodConfig& config, const HandCandidate& candidate);

/// What the weights weigh, in the order in which HandLikelihoodWeights visits them; the first is 1.
using HandLooks = std::array<double, 14>;
HandLooks LooksOf(const HandCandidate& candidate);
std::array<const char*, 14> NamesOfLooks();

}  // namespace deixis::hand_tracker
