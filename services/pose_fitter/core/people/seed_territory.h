#pragma once
#include <cstdint>
#include <vector>

#include "services/pose_fitter/core/people/surface_runs.h"

namespace deixis::pose_fitter {

/// Which pixels people who are followed already may take: where they are expected, and what lies
/// around that. Keeps the pixels of one of them together, and apart from those of others and of
/// furniture that he touches. Takes its memory once per size.
class SeedTerritory {
 public:
  /// `seeds`: per pixel, row by row: 0 = nobody, else who is expected there; empty = nobody
  /// anywhere. `reach_px`: how far around him, along rows plus along columns.
  void Update(const std::vector<std::uint8_t>& seeds, int width_px, int height_px, int reach_px);

  bool is_empty() const { return is_empty_; }
  /// Takes from `links` of a row what joins pixels of different owners.
  void Cut(int row, std::uint8_t* links) const;
  /// Whose the pieces of `runs` are: 0 = nobody's; at least `least_share` of their pixels are where
  /// he is expected. Valid until the next call.
  const std::vector<std::uint8_t>& OwnersOf(const SurfaceRuns& runs, int piece_count,
                                            double least_share);

 private:
  void Spread(int reach_px);
  void Take(std::size_t pixel, std::size_t from, int reach_px);

  bool is_empty_ = true;
  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<std::uint8_t> owners_;     ///< Per pixel.
  std::vector<std::uint8_t> distances_;  ///< Per pixel, to where the owner is expected.
  std::vector<int> pixels_, expected_;   ///< Per piece.
  std::vector<std::uint8_t> owner_of_piece_;
};

}  // namespace deixis::pose_fitter
