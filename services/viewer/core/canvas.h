#pragma once
#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "common/scene/box.h"

namespace deixis::viewer {

/// Where a text stands relative to its point.
enum class Anchor { kAbove, kBelow, kCentred };

/// How a shape's line is drawn: broken for what is remembered rather than seen.
enum class Stroke { kFull, kBroken };

/// Draws shapes and texts whose line widths and letters grow with the picture, so that they read
/// the same at 320x240 and at 1920x1080. Positions in pixels of the picture; anything may lie
/// outside it.
class Canvas {
 public:
  explicit Canvas(const cv::Mat& bgr);

  void DrawBox(const scene::Box& box, const cv::Scalar& colour, double width, Stroke stroke);
  void DrawCircle(const Eigen::Vector2d& centre_px, double radius_px, const cv::Scalar& colour,
                  double width, Stroke stroke);
  void DrawDot(const Eigen::Vector2d& centre_px, double radius_px, const cv::Scalar& colour);
  void DrawArrow(const Eigen::Vector2d& from_px, const Eigen::Vector2d& to_px,
                 const cv::Scalar& colour, double width);
  /// A closed line through at least two points.
  void DrawOutline(const std::vector<Eigen::Vector2d>& points_px, const cv::Scalar& colour,
                   double width, Stroke stroke);
  /// Covers what lies within an outline with a colour, opacity 0..1.
  void Tint(const std::vector<Eigen::Vector2d>& points_px, const cv::Scalar& colour,
            double opacity);
  /// A translucent sector from `start_rad` to `end_rad`, from x towards y.
  void DrawSector(const Eigen::Vector2d& centre_px, double radius_px, double start_rad,
                  double end_rad, const cv::Scalar& colour);
  /// Text on a dark ground, moved into the picture where it would leave it. `size` 1 = usual.
  void DrawText(const std::string& text, const Eigen::Vector2d& at_px, Anchor anchor, double size,
                const cv::Scalar& colour);

  double unit_px() const { return unit_px_; }  ///< 1 at a height of 480.
  cv::Size size() const { return picture_.size(); }
  const cv::Mat& picture() const { return picture_; }

 private:
  int Thickness(double width) const;
  void Darken(const cv::Rect& area);
  void TintWithin(const std::vector<cv::Point>& outline, const cv::Scalar& colour, double opacity);

  cv::Mat picture_;
  double unit_px_;
};

}  // namespace deixis::viewer
