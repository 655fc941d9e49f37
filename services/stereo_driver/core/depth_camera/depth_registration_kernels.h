#pragma once
#include <algorithm>
#include <cstdint>

namespace deixis::stereo_driver {

/// Neighbours of one surface differ in distance by less, as a share of the distance.
constexpr float kSurfaceShare = 0.03F;

/// Of a row of pixels: their rays times the rotation and the camera matrix of the target.
struct Rays {
  const float* u = nullptr;
  const float* v = nullptr;
  const float* z = nullptr;
};

/// The translation times the target's camera matrix, millimetres.
struct Offset {
  float u = 0.0F;
  float v = 0.0F;
  float z = 0.0F;
};

/// Where the pixels of a row lie in the target.
struct Projected {
  float* u_px = nullptr;
  float* v_px = nullptr;
  float* z_mm = nullptr;  ///< Along the target's optical axis; 0 = not measured, or not before it.
};

void ProjectRow(const Rays& rays, const Offset& offset, const std::uint16_t* depth_mm, int width,
                const Projected& projected);

/// For each of `width - 1` places between pixels x and x + 1 of two rows: 1 where all four are
/// measured and belong to one surface, else 0.
void FindSurface(const float* upper_z_mm, const float* lower_z_mm, int width,
                 std::int32_t* goes_on);

/// Whole numbers from first to last; none when last is smaller.
struct Span {
  std::int32_t first = 0;
  std::int32_t last = -1;
};

/// Of 0..last, those between the least and the largest of four. Without branches, for vectors of
/// them. With a corner that is not finite, none: it lies nowhere.
[[gnu::always_inline]] inline Span SpanOf(float a, float b, float c, float d, float last) {
  constexpr float kMargin = 1e-3F;  // Rounding opens no crack at a pixel's centre.
  const float least = std::min(std::min(a, b), std::min(c, d)) - kMargin;
  const float largest = std::max(std::max(a, b), std::max(c, d)) + kMargin;
  const float from = std::min(last + 1.0F, std::max(0.0F, least));
  const float to = std::max(-1.0F, std::min(last, largest));
  const auto floor = static_cast<std::int32_t>(from);
  const std::int32_t is_between = static_cast<float>(floor) < from ? 1 : 0;
  const bool is_finite = 0.0F * (a + b + c + d) == 0.0F;
  return {floor + is_between, is_finite ? static_cast<std::int32_t>(to + 1.0F) - 1 : -1};
}

/// Spans of rows of quads.
struct Spans {
  std::int32_t* first_u = nullptr;
  std::int32_t* last_u = nullptr;
  std::int32_t* first_v = nullptr;
  std::int32_t* last_v = nullptr;
};

/// Which pixels of the target can lie in the quad between x and x + 1 of two rows; none where the
/// surface does not go on. The target's pixels go from 0 to `last_u_px` and `last_v_px`.
void FindSpans(const Projected& upper, const Projected& lower, const std::int32_t* goes_on,
               int width, float last_u_px, float last_v_px, const Spans& spans);

}  // namespace deixis::stereo_driver
