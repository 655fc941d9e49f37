#include "services/pose_fitter/core/bodies/loose_ends.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "common/config/config.h"

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMost = 3;
constexpr double kNearest_m = 0.3;
constexpr int kBeside_px = 2;  // A surface touches the body over this many pixels that are neither.

/// The pixels that may show what is within `reach_m` of the place.
cv::Rect BoxAround(const Vector3d& place_m, double reach_m, const DepthCamera& camera) {
  const double z_m = std::max(kNearest_m, place_m.z());
  const Eigen::Vector2d centre = camera.Project({place_m.x(), place_m.y(), z_m});
  const Eigen::Vector2d extent =
      camera.focal_px * (reach_m / std::max(kNearest_m, z_m - 0.5 * reach_m));
  const Eigen::Vector2i low = (centre - extent).array().floor().cast<int>();
  const Eigen::Vector2i high = (centre + extent).array().ceil().cast<int>();
  return cv::Rect(cv::Point(low.x(), low.y()), cv::Point(high.x() + 1, high.y() + 1)) &
         cv::Rect(0, 0, camera.width_px, camera.height_px);
}

}  // namespace

void LooseEndsConfig::Validate() const {
  config::Faults faults;
  faults.Require(least_area_m2 > 0.0, "least_area_m2", "must be positive");
  faults.Require(joined_m > 0.0, "joined_m", "must be positive");
  faults.Require(least_m >= 0.0, "least_m", "must not be negative");
  faults.ThrowIfAny();
}

const std::vector<Vector3d>& LooseEnds::Find(const BodyEvidence& evidence, const Vector3d& joint_m,
                                             double reach_m, const ImageContext& context) {
  points_m_.clear();
  joint_m_ = joint_m;
  reach_m_ = reach_m;
  box_ = BoxAround(joint_m, reach_m, evidence.view().camera());
  if (box_.empty()) return points_m_;
  Mark(evidence, context);
  Measure(evidence);
  std::sort(ends_.begin(), ends_.end(),
            [](const End& a, const End& b) { return a.area_m2 > b.area_m2; });
  for (const End& end : ends_) {
    const bool counts =
        end.is_joined && end.area_m2 >= config_.least_area_m2 && end.farthest_m >= config_.least_m;
    if (counts && points_m_.size() < kMost) points_m_.push_back(end.point_m);
  }
  return points_m_;
}

void LooseEnds::Mark(const BodyEvidence& evidence, const ImageContext& context) {
  const DepthView& view = evidence.view();
  loose_.create(box_.size(), CV_8UC1);
  for (int y = 0; y < box_.height; ++y) {
    auto* row = loose_.ptr<std::uint8_t>(y);
    for (int x = 0; x < box_.width; ++x) {
      const int u = box_.x + x, v = box_.y + y;
      row[x] = 0;
      if (view.z_m(u, v) <= 0.0F || evidence.IsBody(u, v) || !context.MayBeBody(view, u, v)) {
        continue;
      }
      const Vector3d point_m = view.Point(u, v);
      if ((point_m - joint_m_).norm() <= reach_m_ && evidence.IsAboveFloor(point_m)) {
        row[x] = 1;
      }
    }
  }
}

void LooseEnds::Measure(const BodyEvidence& evidence) {
  const DepthView& view = evidence.view();
  const int count = cv::connectedComponents(loose_, labels_, 8, CV_32S);
  ends_.assign(static_cast<std::size_t>(count), {});
  const double pixel_m = 1.0 / view.camera().focal_px.x();
  for (int y = 0; y < box_.height; ++y) {
    const auto* labels = labels_.ptr<int>(y);
    for (int x = 0; x < box_.width; ++x) {
      if (labels[x] == 0) continue;
      End& end = ends_[static_cast<std::size_t>(labels[x])];
      const Vector3d point_m = view.Point(box_.x + x, box_.y + y);
      const double width_m = point_m.z() * pixel_m;
      end.area_m2 += width_m * width_m;
      const double away_m = (point_m - joint_m_).norm();
      if (away_m > end.farthest_m) {
        end.farthest_m = away_m;
        end.point_m = point_m;
      }
      end.is_joined = end.is_joined || TouchesBody(evidence, box_.x + x, box_.y + y);
    }
  }
}

bool LooseEnds::TouchesBody(const BodyEvidence& evidence, int u, int v) const {
  const DepthView& view = evidence.view();
  const auto z_m = static_cast<double>(view.z_m(u, v));
  for (int y = std::max(0, v - kBeside_px); y <= std::min(view.height_px() - 1, v + kBeside_px);
       ++y) {
    for (int x = std::max(0, u - kBeside_px); x <= std::min(view.width_px() - 1, u + kBeside_px);
         ++x) {
      if (!evidence.IsBody(x, y)) continue;
      if (std::abs(static_cast<double>(view.z_m(x, y)) - z_m) < config_.joined_m) return true;
    }
  }
  return false;
}

}  // namespace deixis::pose_fitter
