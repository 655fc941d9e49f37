#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/time/timestamp.h"
#include "services/calibrator/core/board.h"

namespace deixis::calibrator {

/// What one camera sees of the board, and what can be said of it before the lens is known.
struct View {
  cv::Size size;  ///< Of the picture.
  Corners corners;
  std::optional<double> edge_width_px;  ///< Blur; nothing = the squares are too small to tell.
  cv::Point2d centre;                   ///< Of the board seen; 0..1 across and down the picture.
  double extent = 0.0;                  ///< Root of the share of the picture that the board takes.
  double tilt_right_deg =
      0.0;  ///< Against the picture; above 0: its right side is farther away. Rough.
  double tilt_down_deg = 0.0;  ///< Above 0: its lower side is farther away. Rough.
};

/// One picture of each camera, taken together; one camera: one view.
struct Shot {
  std::string name;  ///< File, or number in the stream.
  Timestamp time;
  std::vector<View> views;
};

/// The board in `grey` (CV_8UC1); nothing when it is not found.
std::optional<View> Look(const cv::Mat& grey, const Board& board);

/// Mean way of the shared corners from `a` to `b`, pixels; nothing when they share fewer than
/// four.
std::optional<double> CornerMotion_px(const Corners& a, const Corners& b);

}  // namespace deixis::calibrator
