#pragma once
#include "services/calibrator/core/board.h"

namespace deixis::calibrator {

/// A chessboard with markers; any six of its corners that are not on one line are enough. The
/// layout is that of OpenCV 4.6 (boards with an even number of rows differ from later versions'
/// unless those set the legacy pattern). Throws std::invalid_argument on an unknown dictionary, or
/// one with too few markers.
Board MakeCharuco(const BoardConfig& config);

}  // namespace deixis::calibrator
