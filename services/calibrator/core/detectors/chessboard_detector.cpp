#include "services/calibrator/core/detectors/chessboard_detector.h"

#include <numeric>
#include <opencv2/calib3d.hpp>

#include "services/calibrator/core/detectors/corner_refinement.h"

namespace deixis::calibrator {
namespace {

/// Share of a square's side over which an edge is free of other print.
constexpr double kClearShare = 0.35;
constexpr double kWindowShare = 0.3;  // Half the side of a corner's window, of the way to the next.

BoardLayout LayoutOf(const BoardConfig& config) {
  BoardLayout layout;
  layout.corners = config.count;
  layout.square_m = config.square_m;
  layout.clear_m = kClearShare * config.square_m;
  layout.size_m = {(config.count.width + 1) * config.square_m,
                   (config.count.height + 1) * config.square_m};
  for (int row = 0; row <= config.count.height; ++row) {
    for (int column = row % 2; column <= config.count.width; column += 2) {
      layout.black_m.emplace_back(column * config.square_m, row * config.square_m, config.square_m,
                                  config.square_m);
    }
  }
  for (int row = 1; row <= config.count.height; ++row) {
    for (int column = 1; column <= config.count.width; ++column) {
      layout.corners_m.emplace_back(static_cast<float>(column * config.square_m),
                                    static_cast<float>(row * config.square_m), 0.0F);
    }
  }
  return layout;
}

class ChessboardDetector final : public CornerDetector {
 public:
  explicit ChessboardDetector(cv::Size count) : count_(count) {}

  std::optional<Corners> Detect(const cv::Mat& grey) const override {
    Corners corners;
    constexpr int kFlags =
        cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK;
    if (!cv::findChessboardCorners(grey, count_, corners.points_px, kFlags)) return std::nullopt;
    corners.ids.resize(corners.points_px.size());
    std::iota(corners.ids.begin(), corners.ids.end(), 0);
    RefineCorners(grey, count_.width, kWindowShare, corners);
    return corners;
  }

 private:
  cv::Size count_;
};

}  // namespace

Board MakeChessboard(const BoardConfig& config) {
  return {LayoutOf(config), std::make_unique<ChessboardDetector>(config.count)};
}

}  // namespace deixis::calibrator
