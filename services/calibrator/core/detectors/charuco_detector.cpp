#include "services/calibrator/core/detectors/charuco_detector.h"

#include <algorithm>
#include <opencv2/aruco/charuco.hpp>
#include <set>
#include <stdexcept>
#include <utility>

#include "services/calibrator/core/detectors/corner_refinement.h"

namespace deixis::calibrator {
namespace {
namespace aruco = cv::aruco;

constexpr std::size_t kFewestCorners = 6;
constexpr double kWindowShare = 0.75;  // Half the side of a corner's window, of what is clear.

const std::vector<std::pair<std::string, int>>& Dictionaries() {
  static const std::vector<std::pair<std::string, int>> kNames{
      {"4X4_50", aruco::DICT_4X4_50},
      {"4X4_100", aruco::DICT_4X4_100},
      {"4X4_250", aruco::DICT_4X4_250},
      {"4X4_1000", aruco::DICT_4X4_1000},
      {"5X5_50", aruco::DICT_5X5_50},
      {"5X5_100", aruco::DICT_5X5_100},
      {"5X5_250", aruco::DICT_5X5_250},
      {"5X5_1000", aruco::DICT_5X5_1000},
      {"6X6_50", aruco::DICT_6X6_50},
      {"6X6_100", aruco::DICT_6X6_100},
      {"6X6_250", aruco::DICT_6X6_250},
      {"6X6_1000", aruco::DICT_6X6_1000},
      {"7X7_50", aruco::DICT_7X7_50},
      {"7X7_100", aruco::DICT_7X7_100},
      {"7X7_250", aruco::DICT_7X7_250},
      {"7X7_1000", aruco::DICT_7X7_1000},
      {"ARUCO_ORIGINAL", aruco::DICT_ARUCO_ORIGINAL}};
  return kNames;
}

cv::Ptr<aruco::Dictionary> DictionaryOf(const std::string& name) {
  std::string known;
  for (const auto& [text, number] : Dictionaries()) {
    if (name == text || name == "DICT_" + text) return aruco::getPredefinedDictionary(number);
    known += (known.empty() ? "" : ", ") + text;
  }
  throw std::invalid_argument("--dictionary '" + name + "' is unknown: there are " + known);
}

cv::Ptr<aruco::CharucoBoard> BoardOf(const BoardConfig& config) {
  const auto dictionary = DictionaryOf(config.dictionary);
  if (config.count.area() / 2 > dictionary->bytesList.rows) {
    throw std::invalid_argument("--dictionary " + config.dictionary + " has " +
                                std::to_string(dictionary->bytesList.rows) +
                                " markers, too few for this board: take a larger one");
  }
  return aruco::CharucoBoard::create(config.count.width, config.count.height,
                                     static_cast<float>(config.square_m),
                                     static_cast<float>(config.marker_m), dictionary);
}

/// The black modules of marker `id` whose top left lies at `place` on the paper.
void AddMarker(const aruco::CharucoBoard& board, int id, cv::Point2d place, BoardLayout& layout) {
  const int modules = board.dictionary->markerSize + 2;
  cv::Mat picture;
  board.dictionary->drawMarker(id, modules, picture);
  const double side = static_cast<double>(board.getMarkerLength()) / modules;
  for (int v = 0; v < modules; ++v) {
    for (int u = 0; u < modules; ++u) {
      if (picture.at<std::uint8_t>(v, u) != 0) continue;
      layout.black_m.emplace_back(place.x + u * side, place.y + v * side, side, side);
    }
  }
}

/// A point of OpenCV's board on the paper: up to 4.5 its y goes up from the lower left corner, from
/// 4.6 on down from the upper left one.
class Paper {
 public:
  explicit Paper(const aruco::CharucoBoard& board)
      : is_upwards_(board.objPoints.front()[0].y > board.objPoints.front()[3].y),
        height_m_(board.getSquareLength() * static_cast<float>(board.getChessboardSize().height)) {}

  cv::Point3f operator()(const cv::Point3f& point) const {
    return {point.x, is_upwards_ ? height_m_ - point.y : point.y, 0.0F};
  }

 private:
  bool is_upwards_;
  float height_m_;
};

/// Black squares are those without a marker.
void AddSquares(const std::vector<cv::Point3f>& markers, const BoardConfig& config,
                BoardLayout& layout) {
  std::set<std::pair<int, int>> white;
  for (const cv::Point3f& marker : markers) {
    white.insert({static_cast<int>(marker.y / config.square_m),
                  static_cast<int>(marker.x / config.square_m)});
  }
  for (int row = 0; row < config.count.height; ++row) {
    for (int column = 0; column < config.count.width; ++column) {
      if (white.count({row, column}) > 0) continue;
      layout.black_m.emplace_back(column * config.square_m, row * config.square_m, config.square_m,
                                  config.square_m);
    }
  }
}

BoardLayout LayoutOf(const BoardConfig& config, const aruco::CharucoBoard& board) {
  BoardLayout layout;
  layout.corners = {config.count.width - 1, config.count.height - 1};
  layout.square_m = config.square_m;
  layout.has_certain_ids = true;
  layout.clear_m = 0.4 * (config.square_m - config.marker_m);
  layout.size_m = {config.count.width * config.square_m, config.count.height * config.square_m};
  const Paper on_paper(board);
  std::vector<cv::Point3f> markers;
  for (const auto& corners : board.objPoints) markers.push_back(on_paper(corners[0]));
  AddSquares(markers, config, layout);
  for (std::size_t i = 0; i < markers.size(); ++i) {
    AddMarker(board, board.ids[i], {markers[i].x, markers[i].y}, layout);
  }
  for (const cv::Point3f& corner : board.chessboardCorners) {
    layout.corners_m.push_back(on_paper(corner));
  }
  return layout;
}

Corners InOrder(const std::vector<int>& ids, const std::vector<cv::Point2f>& points) {
  std::vector<std::pair<int, cv::Point2f>> pairs;
  for (std::size_t i = 0; i < ids.size(); ++i) pairs.emplace_back(ids[i], points[i]);
  std::sort(pairs.begin(), pairs.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  Corners corners;
  for (const auto& [id, point] : pairs) {
    corners.ids.push_back(id);
    corners.points_px.push_back(point);
  }
  return corners;
}

class CharucoDetector final : public CornerDetector {
 public:
  CharucoDetector(cv::Ptr<aruco::CharucoBoard> board, const BoardLayout& layout)
      : board_(std::move(board)),
        columns_(layout.corners.width),
        window_share_(kWindowShare * layout.clear_m / layout.square_m) {}

  std::optional<Corners> Detect(const cv::Mat& grey) const override {
    std::vector<std::vector<cv::Point2f>> markers;
    std::vector<int> marker_ids;
    aruco::detectMarkers(grey, board_->dictionary, markers, marker_ids);
    if (marker_ids.empty()) return std::nullopt;
    std::vector<cv::Point2f> points;
    std::vector<int> ids;
    aruco::interpolateCornersCharuco(markers, marker_ids, grey, board_, points, ids);
    if (ids.size() < kFewestCorners || aruco::testCharucoCornersCollinear(board_, ids)) {
      return std::nullopt;
    }
    // As they come, OpenCV 4.6's corners lie half a pixel too far right and down.
    Corners corners = InOrder(ids, points);
    RefineCorners(grey, columns_, window_share_, corners);
    return corners;
  }

 private:
  cv::Ptr<aruco::CharucoBoard> board_;
  int columns_;
  double window_share_;  ///< Of the way to the next corner.
};

}  // namespace

Board MakeCharuco(const BoardConfig& config) {
  const auto board = BoardOf(config);
  BoardLayout layout = LayoutOf(config, *board);
  auto detector = std::make_unique<CharucoDetector>(board, layout);
  return {std::move(layout), std::move(detector)};
}

}  // namespace deixis::calibrator
