#pragma once
#include "services/calibrator/core/board.h"

namespace deixis::calibrator {

/// Moves each corner to where the edges around it meet (Förstner and Gülch 1987), in a window of
/// its own: half its side is `share` of the way to the nearest neighbour, since one that takes in
/// other print is drawn to it. `columns`: corners per row of the board. `grey`: CV_8UC1.
void RefineCorners(const cv::Mat& grey, int columns, double share, Corners& corners);

}  // namespace deixis::calibrator
