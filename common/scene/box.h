#pragma once
#include <Eigen/Core>
#include <algorithm>

namespace deixis::scene {

/// Upright rectangle in an image, pixels: left, top, width, height.
struct Box {
  double x_px = 0.0;
  double y_px = 0.0;
  double width_px = 0.0;
  double height_px = 0.0;
};

inline Eigen::Vector2d Centre(const Box& box) {
  return {box.x_px + 0.5 * box.width_px, box.y_px + 0.5 * box.height_px};
}

/// Distance in pixels from a point to the box; 0 inside it.
inline double DistanceTo(const Box& box, const Eigen::Vector2d& point_px) {
  const Eigen::Array2d low(box.x_px, box.y_px);
  const Eigen::Array2d high = low + Eigen::Array2d(box.width_px, box.height_px);
  return (low - point_px.array()).max(point_px.array() - high).max(0.0).matrix().norm();
}

/// Area of intersection over area of union, 0..1; 0 for empty boxes.
inline double Overlap(const Box& a, const Box& b) {
  const double width =
      std::min(a.x_px + a.width_px, b.x_px + b.width_px) - std::max(a.x_px, b.x_px);
  const double height =
      std::min(a.y_px + a.height_px, b.y_px + b.height_px) - std::max(a.y_px, b.y_px);
  if (width <= 0.0 || height <= 0.0) return 0.0;
  const double both = width * height;
  return both / (a.width_px * a.height_px + b.width_px * b.height_px - both);
}

}  // namespace deixis::scene
