#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "services/hand_tracker/core/skin_regions.h"

namespace deixis::hand_tracker {

/// Distances inside a region, around its corners: steps of 5 along and 7 across the grid (Borgefors
/// 1986), so that a fifth of a value is in pixels.
class RegionGeodesics {
 public:
  static constexpr int kStep = 5;

  explicit RegionGeodesics(const SkinRegion& region);

  /// Distance of every pixel of the region from `start` (index of a pixel).
  std::vector<int> DistancesFrom(int start) const;

  /// Half width of the region at its widest place, pixels.
  double WidestRadius() const;

  int size() const { return static_cast<int>(points_.size()); }
  Eigen::Vector2i point(int pixel) const { return points_[static_cast<std::size_t>(pixel)]; }
  /// Pixel nearest to `place`.
  int NearestTo(const Eigen::Vector2d& place) const;

 private:
  const SkinRegion& region_;
  std::vector<Eigen::Vector2i> points_;
  std::vector<std::array<std::int32_t, 8>> neighbours_;  ///< -1 = outside the region.
};

}  // namespace deixis::hand_tracker
