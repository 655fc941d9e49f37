#include "services/viewer/core/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace deixis::viewer {
namespace {

constexpr double kUsualHeight_px = 480.0;
constexpr double kLetterScale = 0.5;       // OpenCV's font scale at a unit of 1.
constexpr double kSmallestLetters = 0.36;  // Below, letters cannot be read.
constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
constexpr double kStrokePerLetter = 1.2;  // Line width of letters at a font scale of 1.
constexpr double kMostWidth = 0.94;       // Share of the picture's width that a text may take.
constexpr double kFarAway_px = 1e5;       // OpenCV's drawing overflows beyond some 2^15 * 2^4.
constexpr double kDash_px = 7.0;
constexpr double kSectorOpacity = 0.3;
constexpr double kGroundDarkness = 0.62;

cv::Point ToPoint(const Eigen::Vector2d& point_px) {
  const auto clamped = [](double value) {
    return static_cast<int>(std::lround(std::clamp(value, -kFarAway_px, kFarAway_px)));
  };
  return {clamped(point_px.x()), clamped(point_px.y())};
}

cv::Rect AreaOf(const scene::Box& box) {
  const cv::Point corner = ToPoint({box.x_px, box.y_px});
  const cv::Point opposite = ToPoint({box.x_px + box.width_px, box.y_px + box.height_px});
  return {corner, opposite};
}

void DrawPath(const std::vector<cv::Point>& path, const cv::Scalar& colour, int thickness,
              cv::Mat& picture) {
  cv::polylines(picture, path, false, colour, thickness, cv::LINE_AA);
}

void DrawDashes(cv::Point from, cv::Point to, const cv::Scalar& colour, int thickness,
                double dash_px, cv::Mat& picture) {
  const cv::Point2d way = to - from;
  const int dashes = static_cast<int>(std::hypot(way.x, way.y) / (2.0 * dash_px)) + 1;
  const cv::Point2d step = way / (2.0 * dashes - 1.0);  // A dash at either end.
  for (int i = 0; i < dashes; ++i) {
    const cv::Point2d start = cv::Point2d(from) + 2.0 * i * step;
    DrawPath({start, start + step}, colour, thickness, picture);
  }
}

// Dashes go on round corners: an outline of many short edges is broken like one of few long ones.
// What lies outside the picture is cut off first, however far it goes.
void DrawDashedOutline(const std::vector<cv::Point>& corners, const cv::Scalar& colour,
                       int thickness, double dash_px, cv::Mat& picture) {
  double walked_px = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    cv::Point start = corners[i];
    cv::Point end = corners[(i + 1) % corners.size()];
    if (!cv::clipLine(picture.size(), start, end)) continue;
    const cv::Point2d from = start;
    const cv::Point2d way = end - start;
    const double length_px = std::hypot(way.x, way.y);
    for (double at_px = 0.0; at_px < length_px;) {
      const double in_period_px = std::fmod(walked_px + at_px, 2.0 * dash_px);
      const bool is_dash = in_period_px < dash_px;
      const double rest_px = (is_dash ? dash_px : 2.0 * dash_px) - in_period_px;
      const double end_px = std::min(length_px, at_px + std::max(rest_px, 0.5));
      if (is_dash) {
        DrawPath({from + way * (at_px / length_px), from + way * (end_px / length_px)}, colour,
                 thickness, picture);
      }
      at_px = end_px;
    }
    walked_px += length_px;
  }
}

std::vector<cv::Point> ToPoints(const std::vector<Eigen::Vector2d>& points_px) {
  std::vector<cv::Point> points;
  for (const Eigen::Vector2d& point_px : points_px) points.push_back(ToPoint(point_px));
  return points;
}

std::vector<cv::Point> ArcPoints(const Eigen::Vector2d& centre_px, double radius_px,
                                 double start_rad, double end_rad) {
  constexpr int kSteps = 48;
  std::vector<cv::Point> points;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle_rad = start_rad + (end_rad - start_rad) * i / kSteps;
    const Eigen::Vector2d direction(std::cos(angle_rad), std::sin(angle_rad));
    points.push_back(ToPoint(centre_px + radius_px * direction));
  }
  return points;
}

// OpenCV's letters are ASCII; the bytes of others would become several question marks each.
std::string Printable(const std::string& text) {
  std::string printable;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7F) printable += c;
    if (byte >= 0xC0) printable += '?';
  }
  return printable;
}

/// A text with its size in the picture.
struct TextLine {
  std::string text;
  double letters = 1.0;  ///< OpenCV's font scale.
  int thickness = 1;
  int width_px = 0;
  int height_px = 0;  ///< Above the base line.
  int below_px = 0;   ///< Below it.
  int margin_px = 0;
};

TextLine Measured(const std::string& text, double letters) {
  TextLine line;
  line.text = text;
  line.letters = letters;
  line.thickness = std::max(1, static_cast<int>(std::lround(letters * kStrokePerLetter)));
  const cv::Size size = cv::getTextSize(text, kFont, letters, line.thickness, &line.below_px);
  line.width_px = size.width;
  line.height_px = size.height;
  line.margin_px = std::max(2, size.height / 3);
  return line;
}

TextLine Fitted(const std::string& text, double letters, double most_px) {
  const TextLine line = Measured(text, letters);
  return line.width_px > most_px ? Measured(text, letters * most_px / line.width_px) : line;
}

/// The rectangle that a text stands on, moved into the picture.
cv::Rect GroundOf(const TextLine& line, cv::Point corner, Anchor anchor, cv::Size picture) {
  const cv::Size size(line.width_px + 2 * line.margin_px,
                      line.height_px + line.below_px / 2 + 2 * line.margin_px);
  if (anchor == Anchor::kAbove) corner.y -= size.height;
  if (anchor == Anchor::kCentred) corner -= cv::Point(size.width / 2, size.height / 2);
  return {{std::clamp(corner.x, 0, std::max(0, picture.width - size.width)),
           std::clamp(corner.y, 0, std::max(0, picture.height - size.height))},
          size};
}

}  // namespace

Canvas::Canvas(const cv::Mat& bgr)
    : picture_(bgr.clone()), unit_px_(std::min(bgr.rows, bgr.cols) / kUsualHeight_px) {}

int Canvas::Thickness(double width) const {
  return std::max(1, static_cast<int>(std::lround(width * unit_px_)));
}

void Canvas::DrawBox(const scene::Box& box, const cv::Scalar& colour, double width, Stroke stroke) {
  const cv::Rect area = AreaOf(box);
  if (stroke == Stroke::kFull) {
    cv::rectangle(picture_, area, colour, Thickness(width), cv::LINE_AA);
    return;
  }
  const std::array<cv::Point, 4> corners{
      area.tl(), {area.br().x, area.y}, area.br(), {area.x, area.br().y}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    DrawDashes(corners[i], corners[(i + 1) % corners.size()], colour, Thickness(width),
               std::max(3.0, kDash_px * unit_px_), picture_);
  }
}

void Canvas::DrawCircle(const Eigen::Vector2d& centre_px, double radius_px,
                        const cv::Scalar& colour, double width, Stroke stroke) {
  if (stroke == Stroke::kFull) {
    DrawPath(ArcPoints(centre_px, radius_px, 0.0, 2.0 * M_PI), colour, Thickness(width), picture_);
    return;
  }
  constexpr int kDashes = 8;
  for (int i = 0; i < kDashes; ++i) {
    const double start_rad = 2.0 * M_PI * i / kDashes;
    DrawPath(ArcPoints(centre_px, radius_px, start_rad, start_rad + M_PI / kDashes), colour,
             Thickness(width), picture_);
  }
}

void Canvas::DrawDot(const Eigen::Vector2d& centre_px, double radius_px, const cv::Scalar& colour) {
  cv::circle(picture_, ToPoint(centre_px), std::max(1, static_cast<int>(std::lround(radius_px))),
             colour, cv::FILLED, cv::LINE_AA);
}

void Canvas::DrawArrow(const Eigen::Vector2d& from_px, const Eigen::Vector2d& to_px,
                       const cv::Scalar& colour, double width) {
  const double length_px = (to_px - from_px).norm();
  if (length_px < 3.0 * unit_px_) return;
  const double tip_px = std::min(10.0 * unit_px_, 0.5 * length_px);
  cv::arrowedLine(picture_, ToPoint(from_px), ToPoint(to_px), colour, Thickness(width), cv::LINE_AA,
                  0, tip_px / length_px);
}

void Canvas::DrawSector(const Eigen::Vector2d& centre_px, double radius_px, double start_rad,
                        double end_rad, const cv::Scalar& colour) {
  std::vector<cv::Point> outline = ArcPoints(centre_px, radius_px, start_rad, end_rad);
  if (end_rad - start_rad < 2.0 * M_PI - 1e-6) outline.push_back(ToPoint(centre_px));
  TintWithin(outline, colour, kSectorOpacity);
  cv::polylines(picture_, outline, true, colour, Thickness(1.0), cv::LINE_AA);
}

void Canvas::DrawOutline(const std::vector<Eigen::Vector2d>& points_px, const cv::Scalar& colour,
                         double width, Stroke stroke) {
  const std::vector<cv::Point> outline = ToPoints(points_px);
  if (outline.size() < 2) return;
  if (stroke == Stroke::kFull) {
    cv::polylines(picture_, outline, true, colour, Thickness(width), cv::LINE_AA);
    return;
  }
  DrawDashedOutline(outline, colour, Thickness(width), std::max(3.0, kDash_px * unit_px_),
                    picture_);
}

void Canvas::Tint(const std::vector<Eigen::Vector2d>& points_px, const cv::Scalar& colour,
                  double opacity) {
  if (points_px.size() >= 3) TintWithin(ToPoints(points_px), colour, opacity);
}

void Canvas::TintWithin(const std::vector<cv::Point>& outline, const cv::Scalar& colour,
                        double opacity) {
  const cv::Rect area = cv::boundingRect(outline) & cv::Rect({0, 0}, picture_.size());
  if (area.empty()) return;
  cv::Mat ground = picture_(area);
  cv::Mat tinted = ground.clone();
  cv::fillPoly(tinted, std::vector<std::vector<cv::Point>>{outline}, colour, cv::LINE_AA, 0,
               -area.tl());
  cv::addWeighted(tinted, opacity, ground, 1.0 - opacity, 0.0, ground);
}

void Canvas::Darken(const cv::Rect& area) {
  const cv::Rect inside = area & cv::Rect({0, 0}, picture_.size());
  if (inside.empty()) return;
  cv::Mat ground = picture_(inside);
  ground.convertTo(ground, -1, 1.0 - kGroundDarkness);
}

void Canvas::DrawText(const std::string& text, const Eigen::Vector2d& at_px, Anchor anchor,
                      double size, const cv::Scalar& colour) {
  const double letters = std::max(kSmallestLetters, kLetterScale * unit_px_ * size);
  const TextLine line = Fitted(Printable(text), letters, kMostWidth * picture_.cols);
  const cv::Rect ground = GroundOf(line, ToPoint(at_px), anchor, picture_.size());
  Darken(ground);
  const cv::Point start = ground.tl() + cv::Point(line.margin_px, line.margin_px + line.height_px);
  cv::putText(picture_, line.text, start, kFont, line.letters, colour, line.thickness, cv::LINE_AA);
}

}  // namespace deixis::viewer
