#include "services/pose_fitter/core/fitting/body_evidence.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "common/config/config.h"

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNearest_m = 0.2;  // Nearer parts of a limb have no place in the image.

/// A limb as a rod with a radius that changes evenly.
struct Rod {
  Vector3d begin_m, along_m;
  double length2_m2 = 0.0;
  double radius0_m = 0.0, radius1_m = 0.0;

  /// Of the point to its surface, metres; negative inside.
  double Distance_m(const Vector3d& point_m) const {
    const Vector3d from = point_m - begin_m;
    const double share = std::clamp(from.dot(along_m) / length2_m2, 0.0, 1.0);
    return (from - share * along_m).norm() - (radius0_m + share * (radius1_m - radius0_m));
  }
};

Rod RodOf(const body_model::Kinematics& kinematics, int limb) {
  const auto& shape = kinematics.model().limbs()[static_cast<std::size_t>(limb)].shape;
  const auto& frame = kinematics.limb(limb);
  Rod rod;
  rod.begin_m = frame * Vector3d(shape.centre0_m.x(), shape.centre0_m.y(), 0.0);
  rod.along_m =
      frame * Vector3d(shape.centre1_m.x(), shape.centre1_m.y(), shape.length_m) - rod.begin_m;
  rod.length2_m2 = rod.along_m.squaredNorm();
  rod.radius0_m = std::max(shape.a0_m, shape.b0_m);
  rod.radius1_m = std::max(shape.a1_m, shape.b1_m);
  return rod;
}

/// The pixels that may show what lies within `reach_m` of the rod.
cv::Rect BoxOf(const Rod& rod, double reach_m, const DepthCamera& camera) {
  const Vector3d end_m = rod.begin_m + rod.along_m;
  Vector2d low = Vector2d::Constant(1e9), high = -low;
  for (const auto& [point_m, radius_m] :
       {std::pair(rod.begin_m, rod.radius0_m), std::pair(end_m, rod.radius1_m)}) {
    const double z_m = std::max(point_m.z() - radius_m - reach_m, kNearest_m);
    const Vector2d centre = camera.Project({point_m.x(), point_m.y(), std::max(point_m.z(), z_m)});
    const Vector2d extent = camera.focal_px * ((radius_m + reach_m) / z_m);
    low = low.cwiseMin(centre - extent);
    high = high.cwiseMax(centre + extent);
  }
  const cv::Rect all(0, 0, camera.width_px, camera.height_px);
  const auto whole = [](double value) { return static_cast<int>(std::clamp(value, -1e6, 1e6)); };
  const cv::Point corner(whole(std::floor(low.x())), whole(std::floor(low.y())));
  return cv::Rect(corner,
                  cv::Point(whole(std::ceil(high.x())) + 1, whole(std::ceil(high.y())) + 1)) &
         all;
}

}  // namespace

void BodyEvidenceConfig::Validate() const {
  config::Faults faults;
  faults.Require(gate_m > 0.0, "gate_m", "must be positive");
  faults.Require(above_floor_m >= 0.0, "above_floor_m", "must not be negative");
  faults.Require(points >= 100, "points", "must be at least 100");
  faults.ThrowIfAny();
}

void BodyEvidence::Gather(const DepthView& view, body_model::Kinematics& kinematics,
                          const std::vector<const body_model::BodyPose*>& poses,
                          const std::optional<body_model::Floor>& floor,
                          const ImageContext& context, double gate_m) {
  view_ = &view;
  floor_ = floor;
  body_.create(view.height_px(), view.width_px(), CV_8UC1);
  body_.setTo(0);
  box_ = {};
  for (const body_model::BodyPose* pose : poses) {
    kinematics.Update(*pose);
    MarkBody(kinematics, context, gate_m);
  }
  foreground_ = context.foreground;
  cues_.clear();
  if (context.cues != nullptr) cues_ = *context.cues;
  RemoveIslands();
  MeasureClearance(kinematics.proximal_m(0).z());
  TakePoints();
}

bool BodyEvidence::IsAboveFloor(const Vector3d& point_m) const {
  return !floor_ || floor_->normal.dot(point_m) + floor_->offset_m > config_.above_floor_m;
}

void BodyEvidence::MarkBody(const body_model::Kinematics& kinematics, const ImageContext& context,
                            double gate_m) {
  for (int limb = 0; limb < kinematics.model().limb_count(); ++limb) {
    MarkLimb(kinematics, limb, context, gate_m);
  }
}

void BodyEvidence::MarkLimb(const body_model::Kinematics& kinematics, int limb,
                            const ImageContext& context, double gate_m) {
  const Rod rod = RodOf(kinematics, limb);
  const cv::Rect box = BoxOf(rod, gate_m, view_->camera());
  if (box.empty()) return;
  box_ |= box;
  for (int v = box.y; v < box.y + box.height; ++v) {
    auto* row = body_.ptr<std::uint8_t>(v);
    for (int u = box.x; u < box.x + box.width; ++u) {
      if (row[u] != 0 || view_->z_m(u, v) <= 0.0F || !context.MayBeBody(*view_, u, v)) continue;
      const Vector3d point_m = view_->Point(u, v);
      if (rod.Distance_m(point_m) > gate_m || !IsAboveFloor(point_m)) continue;
      row[u] = 1;
    }
  }
}

void BodyEvidence::MarkNear(const body_model::Kinematics& kinematics, double reach_m,
                            std::vector<std::uint8_t>& pixels) const {
  for (int limb = 0; limb < kinematics.model().limb_count(); ++limb) {
    const Rod rod = RodOf(kinematics, limb);
    const cv::Rect box = BoxOf(rod, reach_m, view_->camera());
    for (int v = box.y; v < box.y + box.height; ++v) {
      for (int u = box.x; u < box.x + box.width; ++u) {
        if (!IsBody(u, v) || rod.Distance_m(view_->Point(u, v)) > reach_m) continue;
        pixels[static_cast<std::size_t>(v * view_->width_px() + u)] = 1;
      }
    }
  }
}

// Small pieces, and such that the body does not touch, are furniture's.
void BodyEvidence::RemoveIslands() {
  pixel_count_ = 0;
  if (box_.empty()) return;
  cv::Mat body = body_(box_);
  cv::connectedComponentsWithStats(body, labels_, stats_, centroids_, 8, CV_32S);
  const int least = std::max(12, box_.area() / 2000);
  for (int v = 0; v < body.rows; ++v) {
    auto* row = body.ptr<std::uint8_t>(v);
    const auto* label = labels_.ptr<int>(v);
    for (int u = 0; u < body.cols; ++u) {
      if (row[u] == 0) continue;
      if (stats_.at<int>(label[u], cv::CC_STAT_AREA) < least) row[u] = 0;
      pixel_count_ += row[u];
    }
  }
}

void BodyEvidence::MeasureClearance(double root_z_m) {
  may_hide_.create(body_.rows, body_.cols, CV_8UC1);
  const auto nearest_m = static_cast<float>(root_z_m - config_.behind_m);
  for (int v = 0; v < body_.rows; ++v) {
    auto* out = may_hide_.ptr<std::uint8_t>(v);
    const auto* body = body_.ptr<std::uint8_t>(v);
    const float* z_m = view_->z_m().data() + static_cast<std::ptrdiff_t>(v) * body_.cols;
    for (int u = 0; u < body_.cols; ++u) {
      out[u] = body[u] != 0 || z_m[u] <= nearest_m ? 0 : 1;
    }
  }
  cv::distanceTransform(may_hide_, clearance_px_, cv::DIST_L2, cv::DIST_MASK_3, CV_32F);
}

void BodyEvidence::TakePoints() {
  points_.Clear();
  if (box_.empty()) return;
  constexpr int kTile = 16;
  const int step = std::max(
      1,
      static_cast<int>(std::lround(std::sqrt(static_cast<double>(pixel_count_) / config_.points))));
  const auto& camera = view_->camera();
  for (int top = box_.y; top < box_.y + box_.height; top += kTile) {
    for (int left = box_.x; left < box_.x + box_.width; left += kTile) {
      for (int v = top; v < std::min(top + kTile, box_.y + box_.height); ++v) {
        if (v % step != 0) continue;
        for (int u = left; u < std::min(left + kTile, box_.x + box_.width); ++u) {
          if ((u + (v / step % 2) * (step / 2)) % step != 0 || !IsBody(u, v)) continue;
          const auto z_m = static_cast<double>(view_->z_m(u, v));
          points_.Add(view_->Point(u, v).cast<float>(),
                      static_cast<float>(camera.noise.Sigma_m(z_m)));
        }
      }
      points_.EndBlock();
    }
  }
}

}  // namespace deixis::pose_fitter
