#include "services/calibrator/core/detectors/corner_refinement.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace deixis::calibrator {
namespace {

constexpr int kSmallestWindow_px = 2;
constexpr int kLargestWindow_px = 15;

/// The shortest way from each corner to a neighbour in its row or column, pixels.
std::vector<double> Spacings_px(const Corners& corners, int columns) {
  std::vector<double> spacings(corners.ids.size(), 1e9);
  for (std::size_t i = 0; i < corners.ids.size(); ++i) {
    for (std::size_t j = i + 1; j < corners.ids.size(); ++j) {
      const int step = corners.ids[j] - corners.ids[i];
      if (step > columns) break;
      const bool is_right = step == 1 && corners.ids[j] % columns != 0;
      if (!is_right && step != columns) continue;
      const double way_px = cv::norm(corners.points_px[i] - corners.points_px[j]);
      spacings[i] = std::min(spacings[i], way_px);
      spacings[j] = std::min(spacings[j], way_px);
    }
  }
  return spacings;
}

}  // namespace

void RefineCorners(const cv::Mat& grey, int columns, double share, Corners& corners) {
  const std::vector<double> spacings_px = Spacings_px(corners, columns);
  for (std::size_t i = 0; i < spacings_px.size(); ++i) {
    const double wanted_px = std::min<double>(share * spacings_px[i], kLargestWindow_px);
    const int half = std::max(cvRound(wanted_px), kSmallestWindow_px);
    std::vector<cv::Point2f> corner{corners.points_px[i]};
    cv::cornerSubPix(grey, corner, {half, half}, {-1, -1},
                     {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 50, 1e-3});
    corners.points_px[i] = corner.front();
  }
}

}  // namespace deixis::calibrator
