#include "services/object_detector/core/sliced_scan.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace deixis::object_detector {
namespace {

constexpr int kGrid_px = 2;  // OpenCV's step at the window's own size.
constexpr int kWindowsPerSlice = 1000;
constexpr double kSameObject = 0.3;  // Overlap from which two answers mean one object.

cv::Mat Resized(const cv::Mat& grey, cv::Size size) {
  if (grey.size() == size) return grey;
  cv::Mat resized;
  const bool shrinks_much = grey.cols > 2 * size.width;
  cv::resize(grey, resized, size, 0.0, 0.0, shrinks_much ? cv::INTER_AREA : cv::INTER_LINEAR);
  return resized;
}

void AddWeighted(const scene::Box& box, CascadeHit& sum) {
  const double n = sum.neighbours;
  const auto mean = [n](double old, double value) { return (n * old + value) / (n + 1.0); };
  sum.box = {mean(sum.box.x_px, box.x_px), mean(sum.box.y_px, box.y_px),
             mean(sum.box.width_px, box.width_px), mean(sum.box.height_px, box.height_px)};
  ++sum.neighbours;
}

std::vector<CascadeHit> Grouped(const std::vector<scene::Box>& boxes) {
  std::vector<CascadeHit> groups;
  for (const scene::Box& box : boxes) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&box](const CascadeHit& group) {
      return scene::Overlap(group.box, box) > kSameObject;
    });
    if (same == groups.end()) {
      groups.push_back({box, 1});
    } else {
      AddWeighted(box, *same);
    }
  }
  std::stable_sort(groups.begin(), groups.end(), [](const CascadeHit& a, const CascadeHit& b) {
    return a.neighbours > b.neighbours;
  });
  return groups;
}

}  // namespace

void ScanConfig::Check(config::Faults& faults) const {
  faults.Require(min_height > 0.0 && min_height < max_height, "cascades.scan.min_height",
                 "must lie between 0 and max_height");
  faults.Require(max_height <= 1.0, "cascades.scan.max_height", "must not be above 1");
  faults.Require(scale_step >= 1.01 && scale_step <= 2.0, "cascades.scan.scale_step",
                 "must lie in 1.01..2");
  faults.Require(round_s > 0.0, "cascades.scan.round_s", "must be positive");
  faults.Require(round_while_none_s > 0.0, "cascades.scan.round_while_none_s", "must be positive");
  faults.Require(pictures_at_start >= 1, "cascades.scan.pictures_at_start", "must be at least 1");
}

SlicedScan::SlicedScan(const ScanConfig& config, cv::Size window)
    : config_(config), window_(window) {}

void SlicedScan::Reset() {
  next_ = 0;
  credit_ = 0.0;
  last_time_.reset();
  is_first_round_ = true;
}

std::vector<CascadeHit> SlicedScan::Next(const GreyPicture& picture, Cascade& cascade,
                                         Urgency urgency) {
  if (picture.grey.size() != planned_for_) Plan(picture.grey.size());
  const std::vector<Slice> slices = TakeSlices(ShareOfRound(picture.time, urgency));
  last_time_ = picture.time;
  std::vector<scene::Box> boxes;
  cv::Mat level;
  for (const Slice& slice : slices) {
    if (level.size() != slice.level) level = Resized(picture.grey, slice.level);
    const cv::Mat band = level.rowRange(slice.first_row, slice.first_row + slice.rows);
    for (const scene::Box& box : cascade.AnswersAtWindowSize(band)) {
      boxes.push_back({box.x_px / slice.scale, (box.y_px + slice.first_row) / slice.scale,
                       box.width_px / slice.scale, box.height_px / slice.scale});
    }
  }
  return Grouped(boxes);
}

void SlicedScan::Plan(cv::Size picture) {
  planned_for_ = picture;
  slices_.clear();
  windows_per_round_ = 0.0;
  Reset();
  const double smallest_px = std::max(config_.min_height * picture.height, 1.0 * window_.height);
  const double largest_px = config_.max_height * picture.height;
  if (largest_px < smallest_px) return;
  const int steps =
      static_cast<int>(std::log(largest_px / smallest_px) / std::log(config_.scale_step));
  for (int step = steps; step >= 0; --step) {
    const double height_px = smallest_px * std::pow(config_.scale_step, step);
    PlanLevel(window_.height / height_px, picture);
  }
}

void SlicedScan::PlanLevel(double scale, cv::Size picture) {
  const cv::Size level(static_cast<int>(std::lround(scale * picture.width)),
                       static_cast<int>(std::lround(scale * picture.height)));
  const int columns = (level.width - window_.width) / kGrid_px + 1;
  const int rows = (level.height - window_.height) / kGrid_px + 1;
  if (columns <= 0 || rows <= 0) return;
  const int rows_per_slice = std::max(1, kWindowsPerSlice / columns);
  for (int row = 0; row < rows; row += rows_per_slice) {
    const int taken = std::min(rows_per_slice, rows - row);
    windows_per_round_ += taken * columns;
    slices_.push_back(
        {scale, level, row * kGrid_px, (taken - 1) * kGrid_px + window_.height, taken * columns});
  }
}

double SlicedScan::ShareOfRound(Timestamp time, Urgency urgency) const {
  const double most = 1.0 / config_.pictures_at_start;
  if (is_first_round_ || !last_time_) return most;
  const double round_s = urgency == Urgency::kForAny ? config_.round_while_none_s : config_.round_s;
  return std::clamp(SecondsBetween(*last_time_, time) / round_s, 0.0, most);
}

std::vector<SlicedScan::Slice> SlicedScan::TakeSlices(double share) {
  std::vector<Slice> taken;
  credit_ = std::min(credit_, 0.0) + share * windows_per_round_;
  while (credit_ > 0.0 && taken.size() < slices_.size()) {
    taken.push_back(slices_[next_]);
    credit_ -= slices_[next_].windows;
    next_ = (next_ + 1) % slices_.size();
    if (next_ == 0) is_first_round_ = false;
  }
  return taken;
}

}  // namespace deixis::object_detector
