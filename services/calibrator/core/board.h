#pragma once
#include <memory>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

namespace deixis::calibrator {

enum class BoardKind {
  kChessboard,
  kCharuco  ///< A chessboard with markers in its white squares: may be partly out of view.
};

/// The board that is held before the camera.
struct BoardConfig {
  BoardKind kind = BoardKind::kChessboard;
  cv::Size count{9, 6};  ///< Chessboard: inner corners per row, rows. ChArUco: squares.
  double square_m = 0.025;
  double marker_m = 0.018;             ///< ChArUco: side of a marker, below that of a square.
  std::string dictionary = "5X5_100";  ///< ChArUco: OpenCV's name without DICT_.
};

/// Throws std::invalid_argument saying what is wrong and the cure.
void RequireValid(const BoardConfig& config);

/// Where things are on the paper: metres, origin at the board's top left, x right, y down.
struct BoardLayout {
  cv::Size corners;  ///< Inner corners per row, rows; corner id = row * columns + column.
  double square_m = 0.0;
  bool has_certain_ids = false;  ///< Markers tell one end of the board from the other.
  double clear_m = 0.0;          ///< No print on the white side of an edge within this distance.
  std::vector<cv::Point3f> corners_m;  ///< By id; z = 0.
  std::vector<cv::Rect2d> black_m;     ///< What is printed.
  cv::Size2d size_m;
};

/// Inner corners of the board that one picture shows.
struct Corners {
  std::vector<int> ids;  ///< Growing.
  std::vector<cv::Point2f> points_px;
};

/// Finds the board in a picture.
class CornerDetector {
 public:
  virtual ~CornerDetector() = default;
  /// `grey`: CV_8UC1. Nothing when the board is not there, or too little of it.
  virtual std::optional<Corners> Detect(const cv::Mat& grey) const = 0;
};

struct Board {
  BoardLayout layout;
  std::unique_ptr<CornerDetector> detector;
};

/// The one place that knows all kinds of boards. Throws std::invalid_argument.
Board MakeBoard(const BoardConfig& config);

/// The points of `corners` on the board, in their order.
std::vector<cv::Point3f> PointsOnBoard(const BoardLayout& layout, const Corners& corners);

/// Those corners of two pictures that are in both, in the same order.
struct SharedCorners {
  Corners first;
  Corners second;
};
SharedCorners Shared(const Corners& first, const Corners& second);

/// The same corners counted from the other end: what a board looks like that was turned by half.
Corners Turned(const Corners& corners, const BoardLayout& layout);

}  // namespace deixis::calibrator
