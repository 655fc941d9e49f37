#include "services/hand_tracker/core/region_geodesics.h"

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace deixis::hand_tracker {
namespace {

constexpr int kFar = std::numeric_limits<int>::max();
constexpr int kDiagonalStep = 7;
// The eight neighbours; the first four share a side.
constexpr std::array<std::array<int, 2>, 8> kOffsets = {
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};

/// Pixels waiting by distance, a ring of buckets (Dial 1969).
class BucketQueue {
 public:
  void Push(int distance, std::int32_t pixel) {
    buckets_[static_cast<std::size_t>(distance % kBuckets)].push_back(pixel);
    ++waiting_;
  }
  bool is_empty() const { return waiting_ == 0; }
  /// All that wait at `distance`.
  std::vector<std::int32_t> Take(int distance) {
    std::vector<std::int32_t> taken;
    std::swap(taken, buckets_[static_cast<std::size_t>(distance % kBuckets)]);
    waiting_ -= taken.size();
    return taken;
  }

 private:
  static constexpr int kBuckets = kDiagonalStep + 1;
  std::array<std::vector<std::int32_t>, kBuckets> buckets_;
  std::size_t waiting_ = 0;
};

}  // namespace

RegionGeodesics::RegionGeodesics(const SkinRegion& region) : region_(region) {
  const int width = region.right - region.left + 3;
  const int height = region.bottom - region.top + 3;
  std::vector<std::int32_t> index(
      static_cast<std::size_t>(width) * static_cast<std::size_t>(height), -1);
  const auto cell = [&](int x, int y) -> std::int32_t& {
    return index[static_cast<std::size_t>((y - region.top + 1) * width + (x - region.left + 1))];
  };
  points_.reserve(static_cast<std::size_t>(region.area_px));
  for (const Run& run : region.runs) {
    for (int x = run.first; x <= run.last; ++x) {
      cell(x, run.row) = static_cast<std::int32_t>(points_.size());
      points_.emplace_back(x, run.row);
    }
  }
  neighbours_.resize(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    for (std::size_t k = 0; k < kOffsets.size(); ++k) {
      neighbours_[i][k] = cell(points_[i].x() + kOffsets[k][0], points_[i].y() + kOffsets[k][1]);
    }
  }
}

std::vector<int> RegionGeodesics::DistancesFrom(int start) const {
  std::vector<int> distances(points_.size(), kFar);
  BucketQueue queue;
  distances[static_cast<std::size_t>(start)] = 0;
  queue.Push(0, start);
  for (int distance = 0; !queue.is_empty(); ++distance) {
    for (const std::int32_t pixel : queue.Take(distance)) {
      if (distances[static_cast<std::size_t>(pixel)] != distance) continue;
      for (std::size_t k = 0; k < kOffsets.size(); ++k) {
        const std::int32_t next = neighbours_[static_cast<std::size_t>(pixel)][k];
        if (next < 0) continue;
        const int longer = distance + (k < 4 ? kStep : kDiagonalStep);
        if (longer >= distances[static_cast<std::size_t>(next)]) continue;
        distances[static_cast<std::size_t>(next)] = longer;
        queue.Push(longer, next);
      }
    }
  }
  return distances;
}

double RegionGeodesics::WidestRadius() const {
  cv::Mat mask =
      cv::Mat::zeros(region_.bottom - region_.top + 3, region_.right - region_.left + 3, CV_8UC1);
  for (const Eigen::Vector2i& point : points_) {
    mask.at<std::uint8_t>(point.y() - region_.top + 1, point.x() - region_.left + 1) = 255;
  }
  cv::Mat inside;
  cv::distanceTransform(mask, inside, cv::DIST_L2, 3);
  double widest = 0.0;
  cv::minMaxLoc(inside, nullptr, &widest);
  return widest;
}

int RegionGeodesics::NearestTo(const Eigen::Vector2d& place) const {
  int nearest = 0;
  double least = std::numeric_limits<double>::max();
  for (int i = 0; i < size(); ++i) {
    const double squared = (point(i).cast<double>() - place).squaredNorm();
    if (squared < least) {
      least = squared;
      nearest = i;
    }
  }
  return nearest;
}

}  // namespace deixis::hand_tracker
