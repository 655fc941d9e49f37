#pragma once
#include "services/calibrator/core/board.h"

namespace deixis::calibrator {

/// A plain chessboard, found only when all of it is in view.
Board MakeChessboard(const BoardConfig& config);

}  // namespace deixis::calibrator
