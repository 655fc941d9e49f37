#include "services/pose_fitter/core/people/seed_territory.h"

#include <algorithm>

#include "services/pose_fitter/core/people/gate_kernels.h"

namespace deixis::pose_fitter {
namespace {

constexpr int kFarthest_px = 254;  // What a byte holds, and one more.

}  // namespace

void SeedTerritory::Update(const std::vector<std::uint8_t>& seeds, int width_px, int height_px,
                           int reach_px) {
  is_empty_ = std::all_of(seeds.begin(), seeds.end(), [](std::uint8_t seed) { return seed == 0; });
  if (is_empty_) return;
  width_px_ = width_px;
  height_px_ = height_px;
  owners_.assign(seeds.begin(), seeds.end());
  distances_.resize(seeds.size());
  std::transform(seeds.begin(), seeds.end(), distances_.begin(), [](std::uint8_t seed) {
    return static_cast<std::uint8_t>(seed != 0 ? 0 : kFarthest_px + 1);
  });
  Spread(std::clamp(reach_px, 0, kFarthest_px));
}

/// Two passes over the picture give each pixel its nearest owner (Rosenfeld and Pfaltz 1966).
void SeedTerritory::Spread(int reach_px) {
  const auto width = static_cast<std::size_t>(width_px_);
  const std::size_t total = owners_.size();
  for (std::size_t i = 0; i < total; ++i) {
    if (i % width != 0) Take(i, i - 1, reach_px);
    if (i >= width) Take(i, i - width, reach_px);
  }
  for (std::size_t i = total; i-- > 0;) {
    if ((i + 1) % width != 0) Take(i, i + 1, reach_px);
    if (i + width < total) Take(i, i + width, reach_px);
  }
}

void SeedTerritory::Take(std::size_t pixel, std::size_t from, int reach_px) {
  const int distance = distances_[from] + 1;
  if (distance > reach_px || distance >= distances_[pixel]) return;
  distances_[pixel] = static_cast<std::uint8_t>(distance);
  owners_[pixel] = owners_[from];
}

void SeedTerritory::Cut(int row, std::uint8_t* links) const {
  const std::uint8_t* owners = owners_.data() + row * static_cast<std::ptrdiff_t>(width_px_);
  const std::uint8_t* above = row > 0 ? owners - width_px_ : owners;
  for (int u = 0; u < width_px_; ++u) {
    const bool is_left_other = u > 0 && owners[u] != owners[u - 1];
    const bool is_above_other = owners[u] != above[u];
    const int cut = (is_left_other ? kJoinsLeft : 0) | (is_above_other ? kJoinsAbove : 0);
    links[u] = static_cast<std::uint8_t>(links[u] & ~cut);
  }
}

const std::vector<std::uint8_t>& SeedTerritory::OwnersOf(const SurfaceRuns& runs, int piece_count,
                                                         double least_share) {
  const auto count = static_cast<std::size_t>(piece_count);
  owner_of_piece_.reserve(255);
  owner_of_piece_.assign(count, 0);
  if (is_empty_) return owner_of_piece_;
  pixels_.assign(count, 0);
  expected_.assign(count, 0);
  for (const SurfaceRun& run : runs.runs()) {
    if (run.component < 0) continue;
    const auto piece = static_cast<std::size_t>(run.component);
    const auto row = run.row_px * static_cast<std::ptrdiff_t>(width_px_);
    // All pixels of a piece have one owner.
    owner_of_piece_[piece] = owners_[static_cast<std::size_t>(row + run.begin_px)];
    pixels_[piece] += run.end_px - run.begin_px;
    expected_[piece] += static_cast<int>(std::count(distances_.begin() + row + run.begin_px,
                                                    distances_.begin() + row + run.end_px, 0));
  }
  for (std::size_t piece = 0; piece < count; ++piece) {
    if (expected_[piece] < least_share * pixels_[piece]) owner_of_piece_[piece] = 0;
  }
  return owner_of_piece_;
}

}  // namespace deixis::pose_fitter
