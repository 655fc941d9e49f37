#include "services/calibrator/core/board.h"

#include <algorithm>
#include <stdexcept>

#include "services/calibrator/core/detectors/charuco_detector.h"
#include "services/calibrator/core/detectors/chessboard_detector.h"

namespace deixis::calibrator {
namespace {

constexpr int kMostPerSide = 100;

void Require(bool holds, const std::string& fault) {
  if (!holds) throw std::invalid_argument(fault);
}

}  // namespace

void RequireValid(const BoardConfig& config) {
  const bool is_chessboard = config.kind == BoardKind::kChessboard;
  const int least = is_chessboard ? 3 : 4;
  const int smaller = std::min(config.count.width, config.count.height);
  const int larger = std::max(config.count.width, config.count.height);
  Require(smaller >= least && larger <= kMostPerSide,
          is_chessboard
              ? "--board must be 3x3 to 100x100 inner corners (count where four squares meet)"
              : "--charuco must be 4x4 to 100x100 squares");
  Require(config.square_m > 0.0005 && config.square_m < 5.0,
          "--square is the side of a square in metres (0.025 = 25 mm)");
  Require(is_chessboard || (config.marker_m > 0.0 && config.marker_m < config.square_m),
          "--marker is the side of a marker in metres and must be below --square");
}

Board MakeBoard(const BoardConfig& config) {
  RequireValid(config);
  switch (config.kind) {
    case BoardKind::kChessboard:
      return MakeChessboard(config);
    case BoardKind::kCharuco:
      return MakeCharuco(config);
  }
  throw std::logic_error("unknown kind of board");
}

std::vector<cv::Point3f> PointsOnBoard(const BoardLayout& layout, const Corners& corners) {
  std::vector<cv::Point3f> points;
  points.reserve(corners.ids.size());
  for (const int id : corners.ids)
    points.push_back(layout.corners_m.at(static_cast<std::size_t>(id)));
  return points;
}

SharedCorners Shared(const Corners& first, const Corners& second) {
  SharedCorners shared;
  std::size_t other = 0;
  for (std::size_t i = 0; i < first.ids.size(); ++i) {
    while (other < second.ids.size() && second.ids[other] < first.ids[i]) ++other;
    if (other == second.ids.size()) break;
    if (second.ids[other] != first.ids[i]) continue;
    shared.first.ids.push_back(first.ids[i]);
    shared.first.points_px.push_back(first.points_px[i]);
    shared.second.ids.push_back(first.ids[i]);
    shared.second.points_px.push_back(second.points_px[other]);
  }
  return shared;
}

Corners Turned(const Corners& corners, const BoardLayout& layout) {
  Corners turned = corners;
  const int last = layout.corners.area() - 1;
  std::reverse(turned.ids.begin(), turned.ids.end());
  std::reverse(turned.points_px.begin(), turned.points_px.end());
  for (int& id : turned.ids) id = last - id;
  return turned;
}

}  // namespace deixis::calibrator
