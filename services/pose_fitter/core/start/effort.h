#pragma once

namespace deixis::pose_fitter {

/// Work that may still be done in one image, counted and not timed: the same images are given the
/// same work whatever runs them. One unit is a point in one round of a fit.
struct Effort {
  static constexpr int kRound = 1000;  ///< What a round costs beside its points.

  int left = 0;

  void Spend(int rounds, int points) { left -= rounds * (kRound + points); }
};

}  // namespace deixis::pose_fitter
