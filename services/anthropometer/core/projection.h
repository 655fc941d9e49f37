#pragma once
#include <Eigen/Core>
#include <cmath>
#include <opencv2/core/types.hpp>

namespace deixis::anthropometer {

/// From where a body is looked at: its front, or its left side.
enum class View { kFront, kSide };

/// Unit vector in the frame of the base limb that is to the right in the picture: from the front
/// the person's left; from its left side what is behind.
inline Eigen::Vector3d RightIn(View view) {
  return view == View::kFront ? Eigen::Vector3d::UnitY() : (-Eigen::Vector3d::UnitX()).eval();
}

/// Parallel, from the frame of the base limb to pixels; up is up.
class Projection {
 public:
  /// `middle_m` comes to the middle of a square picture that shows `span_m` in both directions.
  Projection(View view, const Eigen::Vector3d& middle_m, int height_px, double span_m)
      : view_(view), middle_m_(middle_m), half_px_(0.5 * height_px), per_m_(height_px / span_m) {}

  cv::Point operator()(const Eigen::Vector3d& point_m) const {
    const Eigen::Vector3d offset = per_m_ * (point_m - middle_m_);
    return {static_cast<int>(std::lround(half_px_ + offset.dot(RightIn(view_)))),
            static_cast<int>(std::lround(half_px_ - offset.z()))};
  }
  double Nearness(const Eigen::Vector3d& point_m) const {
    return view_ == View::kFront ? point_m.x() : point_m.y();
  }
  double px_per_m() const { return per_m_; }

 private:
  View view_;
  Eigen::Vector3d middle_m_;
  double half_px_;
  double per_m_;
};

}  // namespace deixis::anthropometer
