#include "services/calibrator/core/detectors/chessboard_detector.h"

#include <numeric>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace deixis::calibrator {
namespace {

/// Share of a square's side over which an edge is free of other print.
constexpr double kClearShare = 0.35;
constexpr int kLargestWindow_px = 11;  // Half the side of the window of the refinement.

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

/// The shortest way between neighbours in a row or a column.
double SmallestSpacing_px(const std::vector<cv::Point2f>& points, cv::Size count) {
  double smallest = 1e9;
  for (int i = 0; i < count.area(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (i % count.width > 0) smallest = std::min(smallest, cv::norm(points[at] - points[at - 1]));
    if (i >= count.width) {
      const auto above = static_cast<std::size_t>(i - count.width);
      smallest = std::min(smallest, cv::norm(points[at] - points[above]));
    }
  }
  return smallest;
}

class ChessboardDetector final : public CornerDetector {
 public:
  explicit ChessboardDetector(cv::Size count) : count_(count) {}

  std::optional<Corners> Detect(const cv::Mat& grey) const override {
    Corners corners;
    constexpr int kFlags =
        cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK;
    if (!cv::findChessboardCorners(grey, count_, corners.points_px, kFlags)) return std::nullopt;
    Refine(grey, corners.points_px);
    corners.ids.resize(corners.points_px.size());
    std::iota(corners.ids.begin(), corners.ids.end(), 0);
    return corners;
  }

 private:
  // A window that reaches the next corner would be drawn to it.
  void Refine(const cv::Mat& grey, std::vector<cv::Point2f>& points) const {
    const double room = 0.45 * SmallestSpacing_px(points, count_);
    const int half = std::clamp(static_cast<int>(room), 2, kLargestWindow_px);
    cv::cornerSubPix(grey, points, {half, half}, {-1, -1},
                     {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 50, 1e-3});
  }

  cv::Size count_;
};

}  // namespace

Board MakeChessboard(const BoardConfig& config) {
  return {LayoutOf(config), std::make_unique<ChessboardDetector>(config.count)};
}

}  // namespace deixis::calibrator
