#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "services/calibrator/core/board.h"

namespace deixis::calibrator {

/// What is said below the printed board: kind, sizes, and what to measure after printing.
std::string BoardCaption(const BoardConfig& config, const BoardLayout& layout);

/// The board alone with a margin of one square, black on white; `px_per_m` pixels per metre.
cv::Mat DrawBoard(const BoardLayout& layout, double px_per_m);

/// A page with the board in its true size, as vectors: A4 (upright or across) when it fits, else as
/// large as needed.
std::string BoardPdf(const BoardLayout& layout, const std::string& caption);

/// The same as PNG file with its resolution noted in it, so that printing programs know the size.
std::vector<std::uint8_t> BoardPng(const BoardLayout& layout, const std::string& caption);

}  // namespace deixis::calibrator
