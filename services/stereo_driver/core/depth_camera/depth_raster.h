#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "services/stereo_driver/core/depth_camera/depth_registration_kernels.h"

namespace deixis::stereo_driver {

/// A point of a surface in a picture: place in pixels, distance along the optical axis.
struct DepthVertex {
  float u_px = 0.0F;
  float v_px = 0.0F;
  float z_mm = 0.0F;
};

/// Four corners: two in one row from left to right, two below from left to right.
using DepthQuad = std::array<DepthVertex, 4>;

/// The plane through three vertices, over the triangle that they make. Distances are interpolated
/// linearly, not their inverse: over neighbours that differ by 3 % that is right to 0.01 %.
class DepthTriangle {
 public:
  DepthTriangle(const DepthVertex& a, const DepthVertex& b, const DepthVertex& c)
      : a_(a),
        b_u_(b.u_px - a.u_px),
        b_v_(b.v_px - a.v_px),
        c_u_(c.u_px - a.u_px),
        c_v_(c.v_px - a.v_px),
        b_z_(b.z_mm - a.z_mm),
        c_z_(c.z_mm - a.z_mm),
        // Of three points in a line: infinite, and no pixel is inside.
        per_area_(1.0F / (b_u_ * c_v_ - b_v_ * c_u_)) {}

  /// 0 outside.
  float DepthAt(float u_px, float v_px) const {
    const float u = u_px - a_.u_px;
    const float v = v_px - a_.v_px;
    const float to_b = (u * c_v_ - v * c_u_) * per_area_;
    const float to_c = (v * b_u_ - u * b_v_) * per_area_;
    const bool is_inside =
        (to_b >= -kMargin) & (to_c >= -kMargin) & (to_b + to_c <= 1.0F + kMargin);
    return is_inside ? a_.z_mm + to_b * b_z_ + to_c * c_z_ : 0.0F;
  }

 private:
  // Share of a side: rounding opens no crack between two triangles.
  static constexpr float kMargin = 1e-3F;

  DepthVertex a_;
  float b_u_, b_v_, c_u_, c_v_, b_z_, c_z_, per_area_;
};

/// Depth in which the nearest wins: CV_16UC1 in millimetres, 0 = nothing yet.
class DepthRaster {
 public:
  /// Writes into the memory of `depth_mm`, which must outlive this object.
  explicit DepthRaster(cv::Mat& depth_mm)
      : pixels_(depth_mm.ptr<std::uint16_t>()),
        stride_(depth_mm.step1()),
        last_u_px_(static_cast<float>(depth_mm.cols - 1)),
        last_v_px_(static_cast<float>(depth_mm.rows - 1)) {}

  /// Fills the pixels whose centres lie in `quad`.
  void Fill(const DepthQuad& quad) {
    const auto& [a, b, c, d] = quad;
    Fill(quad, SpanOf(a.u_px, b.u_px, c.u_px, d.u_px, last_u_px_),
         SpanOf(a.v_px, b.v_px, c.v_px, d.v_px, last_v_px_));
  }

  /// The same, of those within spans of columns and rows, which must lie in the picture.
  void Fill(const DepthQuad& quad, Span columns, Span rows) {
    const auto& [a, b, c, d] = quad;
    const DepthTriangle upper_left(a, b, c);
    const DepthTriangle lower_right(d, c, b);
    for (int y = rows.first; y <= rows.last; ++y) {
      std::uint16_t* row = pixels_ + static_cast<std::size_t>(y) * stride_;
      for (int x = columns.first; x <= columns.last; ++x) {
        float z = upper_left.DepthAt(static_cast<float>(x), static_cast<float>(y));
        if (z == 0.0F) z = lower_right.DepthAt(static_cast<float>(x), static_cast<float>(y));
        Put(z, row[x]);
      }
    }
  }

 private:
  /// The nearest wins; 0, nothing, counts as the farthest: one below it is the largest number.
  static void Put(float z_mm, std::uint16_t& pixel) {
    if (!(z_mm > 0.0F)) return;  // Beyond the corners it may lead behind the camera.
    const auto rounded = static_cast<std::uint16_t>(std::min(z_mm + 0.5F, 65535.0F));
    const auto further = [](std::uint16_t value) { return static_cast<std::uint16_t>(value - 1); };
    if (further(rounded) < further(pixel)) pixel = rounded;
  }

  std::uint16_t* pixels_;
  std::size_t stride_;
  float last_u_px_, last_v_px_;
};

}  // namespace deixis::stereo_driver
