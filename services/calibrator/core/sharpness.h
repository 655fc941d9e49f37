#pragma once
#include <optional>

#include "services/calibrator/core/board.h"

namespace deixis::calibrator {

/// How blurred the board's edges are: the median way over which grey rises from 10 % to 90 %
/// between black and white, pixels (about 2 in focus). Nothing when the squares are too small to
/// tell. `grey`: CV_8UC1.
std::optional<double> EdgeWidth_px(const cv::Mat& grey, const Corners& corners,
                                   const BoardLayout& layout);

}  // namespace deixis::calibrator
