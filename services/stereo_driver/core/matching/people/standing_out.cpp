#include "services/stereo_driver/core/matching/people/standing_out.h"

#include <algorithm>
#include <cmath>

#include "services/stereo_driver/core/matching/disparity.h"

namespace deixis::stereo_driver {
namespace {

constexpr int kCell_px = 8;             // Of half-size pictures.
constexpr int kSampleStep_px = 2;       // Disparities of a cell that are looked at.
constexpr float kLeastStep_m = 0.2F;    // Between somebody and what lies around.
constexpr float kLargestGap_m = 0.15F;  // Between neighbouring cells of one body.
constexpr double kSurroundings = 0.7;  // This share of a row's cells, the nearer ones first, is not
                                       // farther than its surroundings.
constexpr double kFarthest_m = 6.0;
// Of a person, cut by the picture's border perhaps, and beside furniture perhaps.
constexpr double kLeastHeight_m = 0.5;
constexpr double kLeastWidth_m = 0.15, kLargestWidth_m = 1.9;
constexpr double kNearlyAsTall = 0.6;
constexpr double kArm_m = 0.4;  // Lower parts of so much on either side may be an arm.
constexpr std::size_t kLeastCells = 4;

/// The middle one of those that are valid, as a distance; 0 when fewer than half are.
float MedianDistance_m(std::vector<int>& samples, std::size_t count, double focal_baseline) {
  if (samples.empty() || 2 * samples.size() < count) return 0.0F;
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  return static_cast<float>(focal_baseline * kDisparityScale / *middle);
}

/// With a cell more on each side, in full-size pixels.
cv::Rect WindowOf(const cv::Range& columns, const cv::Range& rows) {
  constexpr int kCellFull_px = 2 * kCell_px;
  return {cv::Point(columns.start - 1, rows.start - 1) * kCellFull_px,
          cv::Point(columns.end + 1, rows.end + 1) * kCellFull_px};
}

/// Both; an empty one is nothing.
cv::Range Joined(const cv::Range& a, const cv::Range& b) {
  if (a.empty()) return b;
  return {std::min(a.start, b.start), std::max(a.end, b.end)};
}

}  // namespace

Windows StandingOut::Find(const cv::Mat& half_disparity, const DepthGeometry& geometry) {
  FillGrid(half_disparity, geometry);
  LeaveSurroundingsOut();
  candidates_.clear();
  for (int y = 0; y < cell_m_.rows; ++y) {
    for (int x = 0; x < cell_m_.cols; ++x) {
      if (cell_m_.at<float>(y, x) <= 0.0F) continue;
      Flood({x, y});
      NoteColumns();
      AddWindow(geometry.focal_px);
    }
  }
  std::stable_sort(candidates_.begin(), candidates_.end(),
                   [](const Candidate& a, const Candidate& b) { return a.height > b.height; });
  Windows windows;
  for (const Candidate& candidate : candidates_) windows.push_back(candidate.window);
  return windows;
}

void StandingOut::NoteColumns() {
  distance_m_ = 0.0;
  taken_columns_ = taken_rows_ = {};
  columns_.assign(static_cast<std::size_t>(cell_m_.cols), {});
  for (const Cell& cell : flooded_) {
    const cv::Range row(cell.place.y, cell.place.y + 1);
    cv::Range& column = columns_[static_cast<std::size_t>(cell.place.x)];
    column = Joined(column, row);
    taken_rows_ = Joined(taken_rows_, row);
    taken_columns_ = Joined(taken_columns_, {cell.place.x, cell.place.x + 1});
    distance_m_ += cell.metres / static_cast<double>(flooded_.size());
  }
}

void StandingOut::AddWindow(double focal_px) {
  if (flooded_.size() < kLeastCells || distance_m_ > kFarthest_m) return;
  const double cell_m = distance_m_ * kCell_px / focal_px;
  const double width_m = taken_columns_.size() * cell_m;
  const double height_m = taken_rows_.size() * cell_m;
  if (width_m < kLeastWidth_m || height_m < kLeastHeight_m) return;
  // What is wider is somebody beside or behind furniture: where it is tall.
  const bool is_wide = width_m > kLargestWidth_m;
  const cv::Range columns = is_wide ? TallColumns(cell_m) : taken_columns_;
  cv::Range rows;
  for (int x = columns.start; x < columns.end; ++x) {
    rows = Joined(rows, columns_[static_cast<std::size_t>(x)]);
  }
  candidates_.push_back({WindowOf(columns, rows), rows.size()});
}

cv::Range StandingOut::TallColumns(double cell_m) const {
  const auto is_lower = [](const cv::Range& a, const cv::Range& b) { return a.size() < b.size(); };
  const auto tallest = std::max_element(columns_.begin(), columns_.end(), is_lower);
  const auto middle = static_cast<int>(tallest - columns_.begin());
  const int least = static_cast<int>(kNearlyAsTall * tallest->size());
  cv::Range tall(middle, middle + 1);
  const auto size_at = [this](int x) { return columns_[static_cast<std::size_t>(x)].size(); };
  while (tall.start > taken_columns_.start && size_at(tall.start - 1) >= least) --tall.start;
  while (tall.end < taken_columns_.end && size_at(tall.end) >= least) ++tall.end;
  const int arm = static_cast<int>(std::ceil(kArm_m / cell_m));
  return {std::max(taken_columns_.start, tall.start - arm),
          std::min(taken_columns_.end, tall.end + arm)};
}

void StandingOut::FillGrid(const cv::Mat& half_disparity, const DepthGeometry& geometry) {
  constexpr std::size_t kPerCell = (kCell_px / kSampleStep_px) * (kCell_px / kSampleStep_px);
  const double focal_baseline = geometry.focal_px * geometry.baseline_m;
  cell_m_.create(half_disparity.rows / kCell_px, half_disparity.cols / kCell_px, CV_32FC1);
  for (int y = 0; y < cell_m_.rows; ++y) {
    for (int x = 0; x < cell_m_.cols; ++x) {
      samples_.clear();
      for (int v = y * kCell_px; v < (y + 1) * kCell_px; v += kSampleStep_px) {
        const auto* row = half_disparity.ptr<std::int16_t>(v);
        for (int u = x * kCell_px; u < (x + 1) * kCell_px; u += kSampleStep_px) {
          if (row[u] > 0) samples_.push_back(row[u]);
        }
      }
      cell_m_.at<float>(y, x) = MedianDistance_m(samples_, kPerCell, focal_baseline);
    }
  }
}

// Floor and wall are equally far along a row; whoever stands on the one, before the other, is not.
void StandingOut::LeaveSurroundingsOut() {
  for (int y = 0; y < cell_m_.rows; ++y) {
    auto* row = cell_m_.ptr<float>(y);
    row_m_.clear();
    for (int x = 0; x < cell_m_.cols; ++x) {
      if (row[x] > 0.0F) row_m_.push_back(row[x]);
    }
    if (row_m_.empty()) continue;
    const auto place =
        static_cast<std::ptrdiff_t>(kSurroundings * static_cast<double>(row_m_.size()));
    std::nth_element(row_m_.begin(), row_m_.begin() + place, row_m_.end());
    const float farther_m = row_m_[static_cast<std::size_t>(place)];
    for (int x = 0; x < cell_m_.cols; ++x) {
      if (row[x] > farther_m - kLeastStep_m) row[x] = 0.0F;
    }
  }
}

void StandingOut::Flood(cv::Point start) {
  flooded_.assign(1, {start, cell_m_.at<float>(start)});
  cell_m_.at<float>(start) = 0.0F;
  for (std::size_t i = 0; i < flooded_.size(); ++i) {
    const Cell here = flooded_[i];
    for (const cv::Point step : {cv::Point(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
      const cv::Point next = here.place + step;
      if (!next.inside(cv::Rect({0, 0}, cell_m_.size()))) continue;
      const float metres = cell_m_.at<float>(next);
      if (metres <= 0.0F || std::abs(metres - here.metres) > kLargestGap_m) continue;
      cell_m_.at<float>(next) = 0.0F;
      flooded_.push_back({next, metres});
    }
  }
}

}  // namespace deixis::stereo_driver
