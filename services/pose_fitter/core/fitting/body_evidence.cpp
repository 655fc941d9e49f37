#include "services/pose_fitter/core/fitting/body_evidence.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "common/config/config.h"
#include "services/pose_fitter/core/fitting/evidence_kernels.h"

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNearest_m = 0.2;  // Nearer parts of a limb have no place in the image.
constexpr double kClearance_m =
    0.3;  // Surface that is farther from the body's pixels is not pulled.
constexpr float kEndless_px = 1e4F;

/// A limb as a rod with a radius that changes evenly.
struct Rod {
  Vector3d begin_m, along_m;
  double radius0_m = 0.0, radius1_m = 0.0;
};

Rod RodOf(const body_model::Kinematics& kinematics, int limb) {
  const auto& shape = kinematics.model().limbs()[static_cast<std::size_t>(limb)].shape;
  const auto& frame = kinematics.limb(limb);
  Rod rod;
  rod.begin_m = frame * Vector3d(shape.centre0_m.x(), shape.centre0_m.y(), 0.0);
  rod.along_m =
      frame * Vector3d(shape.centre1_m.x(), shape.centre1_m.y(), shape.length_m) - rod.begin_m;
  rod.radius0_m = std::max(shape.a0_m, shape.b0_m);
  rod.radius1_m = std::max(shape.a1_m, shape.b1_m);
  return rod;
}

GatedRod Gated(const Rod& rod, double gate_m) {
  GatedRod gated{};
  for (int k = 0; k < 3; ++k) {
    gated.begin_m[k] = static_cast<float>(rod.begin_m[k]);
    gated.along_m[k] = static_cast<float>(rod.along_m[k]);
  }
  gated.inverse_length2 = static_cast<float>(1.0 / rod.along_m.squaredNorm());
  gated.reach0_m = static_cast<float>(rod.radius0_m + gate_m);
  gated.reach_change_m = static_cast<float>(rod.radius1_m - rod.radius0_m);
  return gated;
}

/// Of the pixels of row `v` from column `u` on.
GatedRow RowAt(const DepthCamera& camera, int u, int v,
               const std::optional<body_model::Floor>& floor, double above_floor_m) {
  const Vector3d ray = camera.Ray(u, v);
  GatedRow row{};
  row.ray_x = static_cast<float>(ray.x());
  row.ray_x_per_px = static_cast<float>(1.0 / camera.focal_px.x());
  row.ray_y = static_cast<float>(ray.y());
  row.lowest_m = -1.0F;  // No floor: nothing is lower than along no normal.
  if (!floor) return row;
  for (int k = 0; k < 3; ++k) row.floor_normal[k] = static_cast<float>(floor->normal[k]);
  row.lowest_m = static_cast<float>(above_floor_m - floor->offset_m);
  return row;
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
    MarkBody(kinematics, gate_m);
  }
  TakeOut(context.taken, true);
  TakeOut(context.foreground, false);
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

void BodyEvidence::MarkBody(const body_model::Kinematics& kinematics, double gate_m) {
  for (int limb = 0; limb < kinematics.model().limb_count(); ++limb) {
    const Rod rod = RodOf(kinematics, limb);
    const cv::Rect box = BoxOf(rod, gate_m, view_->camera());
    if (box.empty()) continue;
    box_ |= box;
    const GatedRod gated = Gated(rod, gate_m);
    for (int v = box.y; v < box.y + box.height; ++v) {
      MarkRod(gated, RowAt(view_->camera(), box.x, v, floor_, config_.above_floor_m),
              view_->row_m(v) + box.x, box.width, body_.ptr<std::uint8_t>(v) + box.x);
    }
  }
}

void BodyEvidence::TakeOut(const std::vector<std::uint8_t>* pixels, bool where_set) {
  if (pixels == nullptr) return;
  for (int v = box_.y; v < box_.y + box_.height; ++v) {
    const auto first = static_cast<std::ptrdiff_t>(v) * view_->width_px() + box_.x;
    const std::uint8_t* marks = pixels->data() + first;
    auto* row = body_.ptr<std::uint8_t>(v) + box_.x;
    for (int i = 0; i < box_.width; ++i) row[i] = (marks[i] != 0) == where_set ? 0 : row[i];
  }
}

void BodyEvidence::MarkNear(const body_model::Kinematics& kinematics, double reach_m,
                            std::vector<std::uint8_t>& pixels) const {
  for (int limb = 0; limb < kinematics.model().limb_count(); ++limb) {
    const Rod rod = RodOf(kinematics, limb);
    const cv::Rect box = BoxOf(rod, reach_m, view_->camera());
    const GatedRod gated = Gated(rod, reach_m);
    for (int v = box.y; v < box.y + box.height; ++v) {
      MarkRod(gated, RowAt(view_->camera(), box.x, v, floor_, config_.above_floor_m),
              view_->row_m(v) + box.x, box.width,
              pixels.data() + static_cast<std::ptrdiff_t>(v) * view_->width_px() + box.x);
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

// Only about the body: farther off, clearance is as good as endless.
void BodyEvidence::MeasureClearance(double root_z_m) {
  clearance_px_.create(body_.rows, body_.cols, CV_32FC1);
  clearance_px_.setTo(kEndless_px);
  const int margin_px = static_cast<int>(std::clamp(
      view_->camera().focal_px.x() * kClearance_m / std::max(root_z_m, kNearest_m), 8.0, 1e4));
  const cv::Rect all(0, 0, body_.cols, body_.rows);
  const cv::Rect about =
      (box_ + cv::Size(2 * margin_px, 2 * margin_px) - cv::Point(margin_px, margin_px)) & all;
  if (box_.empty() || about.empty()) return;
  may_hide_.create(body_.rows, body_.cols, CV_8UC1);
  const auto nearest_m = static_cast<float>(root_z_m - config_.behind_m);
  for (int v = about.y; v < about.y + about.height; ++v) {
    auto* out = may_hide_.ptr<std::uint8_t>(v);
    const auto* body = body_.ptr<std::uint8_t>(v);
    const float* z_m = view_->row_m(v);
    for (int u = about.x; u < about.x + about.width; ++u) {
      out[u] = body[u] != 0 || z_m[u] <= nearest_m ? 0 : 1;
    }
  }
  cv::Mat clearance_px = clearance_px_(about);
  cv::distanceTransform(may_hide_(about), clearance_px, cv::DIST_L2, cv::DIST_MASK_3, CV_32F);
}

void BodyEvidence::TakePoints() {
  points_.Clear();
  if (box_.empty()) return;
  constexpr int kTile = 16;
  const double pixels_per_point = static_cast<double>(pixel_count_) / config_.points;
  const int step = std::max(1, static_cast<int>(std::sqrt(pixels_per_point)));
  const Sampling sampling{step, std::min(1.0, step * step / pixels_per_point)};
  double due = 0.0;
  for (int top = box_.y; top < box_.y + box_.height; top += kTile) {
    for (int left = box_.x; left < box_.x + box_.width; left += kTile) {
      const int end = std::min(left + kTile, box_.x + box_.width);
      for (int v = top; v < std::min(top + kTile, box_.y + box_.height); ++v) {
        if (v % step == 0) due = TakeRow(left, end, v, sampling, due);
      }
      points_.EndBlock();
    }
  }
}

// Every other row is shifted by half a step.
double BodyEvidence::TakeRow(int begin, int end, int v, const Sampling& sampling, double due) {
  const int step = sampling.step_px;
  const auto& camera = view_->camera();
  const auto* body = body_.ptr<std::uint8_t>(v);
  const int shift = v / step % 2 * (step / 2);
  for (int u = begin + (step - (begin + shift) % step) % step; u < end; u += step) {
    if (body[u] == 0) continue;
    due += sampling.share;
    if (due < 1.0) continue;
    due -= 1.0;
    const auto z_m = static_cast<double>(view_->z_m(u, v));
    points_.Add(view_->Point(u, v).cast<float>(), static_cast<float>(camera.noise.Sigma_m(z_m)));
  }
  return due;
}

}  // namespace deixis::pose_fitter
