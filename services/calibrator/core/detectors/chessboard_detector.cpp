#include "services/calibrator/core/detectors/chessboard_detector.h"

#include <numeric>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace deixis::calibrator {
namespace {

/// Share of a square's side over which an edge is free of other print.
constexpr double kClearShare = 0.35;
constexpr double kWindowShare = 0.3;  // Half the side of a corner's window, of the way to the next.
constexpr int kLargestWindow_px = 15;

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

/// The shortest way from each corner to a neighbour in its row or column, pixels.
std::vector<double> Spacings_px(const std::vector<cv::Point2f>& points, cv::Size count) {
  std::vector<double> spacings(points.size(), 1e9);
  const auto note = [&](std::size_t a, std::size_t b) {
    const double way_px = cv::norm(points[a] - points[b]);
    spacings[a] = std::min(spacings[a], way_px);
    spacings[b] = std::min(spacings[b], way_px);
  };
  const auto columns = static_cast<std::size_t>(count.width);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % columns > 0) note(i, i - 1);
    if (i >= columns) note(i, i - columns);
  }
  return spacings;
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
  // Each corner in a window of its own: one that comes near the next corner is drawn to it.
  void Refine(const cv::Mat& grey, std::vector<cv::Point2f>& points) const {
    const std::vector<double> spacings_px = Spacings_px(points, count_);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const int half = std::clamp(cvRound(kWindowShare * spacings_px[i]), 2, kLargestWindow_px);
      std::vector<cv::Point2f> corner{points[i]};
      cv::cornerSubPix(grey, corner, {half, half}, {-1, -1},
                       {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 50, 1e-3});
      points[i] = corner.front();
    }
  }

  cv::Size count_;
};

}  // namespace

Board MakeChessboard(const BoardConfig& config) {
  return {LayoutOf(config), std::make_unique<ChessboardDetector>(config.count)};
}

}  // namespace deixis::calibrator
