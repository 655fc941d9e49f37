#pragma once
#include "common/config/config.h"
#include "services/stereo_driver/core/matching/refinement.h"

namespace deixis::stereo_driver {

/// Of full-size alignment, which ends nearer to the truth the longer it runs.
inline RefinementConfig FineRefinementDefaults() {
  RefinementConfig config;
  config.iterations = 4;
  config.window_px = 11;
  config.smoothing_px = 9;
  return config;
}

/// Where people are looked for at full size, and how.
struct PeopleConfig {
  double margin_m = 0.25;            ///< Around the ends of limbs: flesh, clothes and errors.
  double speed_m_per_s = 2.0;        ///< By which the margin grows with the age of a pose.
  double memory_s = 1.0;             ///< Older poses are forgotten.
  double largest_share = 0.5;        ///< Of the picture, of what stands out while nobody is said.
  bool sharpens_silhouettes = true;  ///< Whether colours correct the edges of bodies.
  RefinementConfig alignment = FineRefinementDefaults();

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("margin_m", margin_m);
    v("speed_m_per_s", speed_m_per_s);
    v("memory_s", memory_s);
    v("largest_share", largest_share);
    v("sharpens_silhouettes", sharpens_silhouettes);
    v("alignment", alignment);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

}  // namespace deixis::stereo_driver
