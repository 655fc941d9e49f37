#include "services/calibrator/core/coverage.h"

#include <algorithm>

namespace deixis::calibrator {
namespace {

constexpr double kTiltWanted_deg = 15.0;
constexpr double kNearWanted = 0.45;  // Extent: a fifth of the picture.
constexpr double kRangeWanted = 1.3;  // Between the nearest and the farthest view.

int CellOf(double share, int count) {
  return std::clamp(static_cast<int>(share * count), 0, count - 1);
}

struct Region {
  const char* name;
  cv::Rect cells;
};

// Corners of the picture first: they say most about the distortion, and are forgotten most.
const std::vector<Region>& Regions() {
  static const std::vector<Region> kRegions{
      {"the upper left", {0, 0, 2, 2}}, {"the upper right", {6, 0, 2, 2}},
      {"the lower left", {0, 4, 2, 2}}, {"the lower right", {6, 4, 2, 2}},
      {"the left edge", {0, 2, 2, 2}},  {"the right edge", {6, 2, 2, 2}},
      {"the upper edge", {2, 0, 4, 2}}, {"the lower edge", {2, 4, 4, 2}},
      {"the middle", {2, 2, 4, 2}}};
  return kRegions;
}

}  // namespace

void Coverage::Add(const View& view) {
  ++views_;
  for (const cv::Point2f& point : view.corners.points_px) {
    const int column = CellOf(static_cast<double>(point.x) / view.size.width, kCoverageColumns);
    const int row = CellOf(static_cast<double>(point.y) / view.size.height, kCoverageRows);
    ++cells_[static_cast<std::size_t>(row * kCoverageColumns + column)];
  }
  smallest_extent_ = std::min(smallest_extent_, view.extent);
  largest_extent_ = std::max(largest_extent_, view.extent);
  most_right_deg_ = std::max(most_right_deg_, view.tilt_right_deg);
  most_left_deg_ = std::max(most_left_deg_, -view.tilt_right_deg);
  most_down_deg_ = std::max(most_down_deg_, view.tilt_down_deg);
  most_up_deg_ = std::max(most_up_deg_, -view.tilt_down_deg);
}

double Coverage::share() const {
  const auto seen = std::count_if(cells_.begin(), cells_.end(), [](int n) { return n > 0; });
  return static_cast<double>(seen) / static_cast<double>(cells_.size());
}

double Coverage::largest_tilt_deg() const {
  return std::max({most_right_deg_, most_left_deg_, most_down_deg_, most_up_deg_});
}

int Coverage::corners_in(int column, int row) const {
  return cells_.at(static_cast<std::size_t>(row * kCoverageColumns + column));
}

bool Coverage::IsEmpty(cv::Rect cells) const {
  for (int row = cells.y; row < cells.y + cells.height; ++row) {
    for (int column = cells.x; column < cells.x + cells.width; ++column) {
      if (corners_in(column, row) > 0) return false;
    }
  }
  return true;
}

void Coverage::AdvisePlace(std::vector<std::string>& advice) const {
  for (const Region& region : Regions()) {
    if (IsEmpty(region.cells)) {
      advice.push_back(std::string("show the board at ") + region.name + " of the picture");
    }
  }
}

void Coverage::AdviseTilt(std::vector<std::string>& advice) const {
  const auto want = [&advice](double most_deg, const char* side) {
    if (most_deg < kTiltWanted_deg) {
      advice.push_back(std::string("tilt the board: its ") + side + " side away from the camera");
    }
  };
  want(most_right_deg_, "right");
  want(most_left_deg_, "left");
  want(most_down_deg_, "lower");
  want(most_up_deg_, "upper");
}

std::vector<std::string> Coverage::Advice() const {
  std::vector<std::string> advice;
  if (views_ == 0) return {"show the board"};
  AdviseTilt(advice);
  AdvisePlace(advice);
  if (largest_extent_ < kNearWanted) advice.emplace_back("bring the board nearer");
  if (largest_extent_ < kRangeWanted * smallest_extent_) {
    advice.emplace_back("show the board nearer and farther away");
  }
  return advice;
}

}  // namespace deixis::calibrator
