#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace deixis::hand_tracker {

/// A horizontal piece of a region: columns first..last of one row.
struct Run {
  int row = 0;
  int first = 0;
  int last = 0;
};

/// Touching pixels (8 neighbours) of skin evidence.
struct SkinRegion {
  std::vector<Run> runs;  ///< By row, then by column.
  int area_px = 0;
  int left = 0, top = 0, right = 0, bottom = 0;  ///< Inclusive bounds.
};

/// Adds a run that lies in or after the last row of `region`.
void AddRun(const Run& run, SkinRegion& region);

struct HysteresisThresholds {
  int low = 150;   ///< Evidence (0..255) from which a pixel belongs to a region.
  int high = 200;  ///< Evidence that at least one pixel of a region reaches.
};

/// Connected components with hysteresis, found run by run (no label image). Regions smaller than
/// `least_area_px` are left out. Order: by first run from the top.
std::vector<SkinRegion> FindRegions(const cv::Mat& evidence, const HysteresisThresholds& thresholds,
                                    int least_area_px);

}  // namespace deixis::hand_tracker
