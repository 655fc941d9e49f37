#include "services/stereo_driver/core/matching/people/said_people.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace deixis::stereo_driver {
namespace {

constexpr double kNearest_m = 0.2;  // Nearer ends of limbs are behind the camera or cover it all.

/// Grows around what is projected into a picture.
class Outline {
 public:
  Outline(const geometry::CameraCalibration& camera, double margin_m)
      : camera_(camera), margin_m_(margin_m) {}

  void Add(const Eigen::Vector3d& point_m) {
    if (!point_m.allFinite() || point_m.z() < kNearest_m) return;
    const Eigen::Vector2d centre =
        camera_.focal_px.cwiseProduct(point_m.head<2>()) / point_m.z() + camera_.principal_point_px;
    const Eigen::Vector2d reach = camera_.focal_px * (margin_m_ / point_m.z());
    low_ = low_.cwiseMin(centre - reach);
    high_ = high_.cwiseMax(centre + reach);
  }

  /// Empty when nothing lies in the picture.
  cv::Rect Window() const {
    const Eigen::Vector2d size(camera_.width_px, camera_.height_px);
    const Eigen::Vector2d low = low_.cwiseMax(0.0).cwiseMin(size);
    const Eigen::Vector2d high = high_.cwiseMax(0.0).cwiseMin(size);
    if (!(high.x() > low.x()) || !(high.y() > low.y())) return {};
    const cv::Point corner(static_cast<int>(low.x()), static_cast<int>(low.y()));
    const cv::Point other(static_cast<int>(std::ceil(high.x())),
                          static_cast<int>(std::ceil(high.y())));
    return {corner, other};
  }

 private:
  const geometry::CameraCalibration& camera_;
  double margin_m_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Constant(1e9);
  Eigen::Vector2d high_ = Eigen::Vector2d::Constant(-1e9);
};

}  // namespace

SaidPeople::SaidPeople(const PeopleConfig& config, std::string camera)
    : config_(config), camera_(std::move(camera)) {}

void SaidPeople::Hear(const body_model::BodyPoses& poses) {
  if (poses.camera != camera_ || poses.frame != camera_) {
    ++elsewhere_;
    return;
  }
  poses_ = poses;
}

Windows SaidPeople::At(Timestamp time, const geometry::CameraCalibration& rectified) const {
  Windows windows;
  if (!poses_) return windows;
  // A recording that begins again is as far away as one that was long ago.
  const double age_s = std::abs(SecondsBetween(poses_->time, time));
  if (age_s > config_.memory_s) return windows;
  for (const body_model::TrackedBody& body : poses_->bodies) {
    Outline outline(rectified, config_.margin_m + config_.speed_m_per_s * age_s);
    for (const body_model::LimbPose& limb : body.limbs) {
      if (limb.state == body_model::LimbState::kLost) continue;
      outline.Add(limb.proximal_m);
      outline.Add(limb.distal_m);
    }
    if (const cv::Rect window = outline.Window(); !window.empty()) windows.push_back(window);
  }
  return windows;
}

}  // namespace deixis::stereo_driver
