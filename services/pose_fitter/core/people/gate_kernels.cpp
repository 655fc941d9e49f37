#include "services/pose_fitter/core/people/gate_kernels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "common/kernels/kernel.h"

namespace deixis::pose_fitter {
namespace {

constexpr float kLeastLean = 0.07F;  // What is seen along itself shows no area.

[[gnu::always_inline]] inline int IsInside(float z, int u, std::uint8_t is_sound,
                                           const RowGate& gate) {
  const float lean = gate.lean + gate.lean_per_px * static_cast<float>(u);
  const float height = z * lean + gate.camera_height_m;
  const float lowest = gate.lowest_m + gate.noise_per_square_m * z * z * std::abs(lean);
  return static_cast<int>(is_sound) & static_cast<int>(z > gate.near_m) &
         static_cast<int>(z < gate.far_m) & static_cast<int>(height > lowest) &
         static_cast<int>(height < gate.highest_m);
}

[[gnu::always_inline]] inline int IsOneSurface(float z, float other, StepLimit step) {
  const float limit = step.fixed_m + z * (step.per_m + z * step.per_square_m);
  return static_cast<int>(std::abs(z - other) < limit);
}

}  // namespace

DEIXIS_KERNEL void MarkLevelRow(const float* above_m, const float* row_m, const float* below_m,
                                int width, const RowGate& gate, float lean_per_row,
                                float pixel_slope, int distance_px, std::uint8_t* is_level) {
  constexpr float kShare = 0.3F;  // Of what an upright surface would rise.
  const auto rows = static_cast<float>(distance_px);
  for (int u = 0; u < width; ++u) {
    const float z = row_m[u];
    const float lean = gate.lean + gate.lean_per_px * static_cast<float>(u);
    const float limit = kShare * rows * pixel_slope * z;
    const float up = above_m[u] * (lean - rows * lean_per_row) - z * lean;
    const float down = below_m[u] * (lean + rows * lean_per_row) - z * lean;
    const float lowest = gate.lowest_m + gate.noise_per_square_m * z * z * std::abs(lean);
    const float height = z * lean + gate.camera_height_m;
    const int is_flat =
        (static_cast<int>(std::abs(up) < limit) & static_cast<int>(above_m[u] > z)) |
        (static_cast<int>(std::abs(down) < limit) & static_cast<int>(below_m[u] > 0.0F) &
         static_cast<int>(below_m[u] < z));
    is_level[u] = static_cast<std::uint8_t>(
        is_flat & static_cast<int>(z > gate.near_m) & static_cast<int>(z < gate.far_m) &
        static_cast<int>(height > lowest) & static_cast<int>(height < gate.highest_m));
  }
}

void AddLevelArea(const float* row_m, const std::uint8_t* is_level, int width, const RowGate& gate,
                  float* area_per_cm, int bin_count) {
  std::uint64_t eight = 0;
  for (int u = 0; u < width; ++u) {
    if (u % 8 == 0 && u + 8 <= width) {
      std::memcpy(&eight, is_level + u, 8);
      if (eight == 0) {
        u += 7;
        continue;
      }
    }
    if (is_level[u] == 0) continue;
    const float z = row_m[u];
    const float lean = gate.lean + gate.lean_per_px * static_cast<float>(u);
    const auto bin = static_cast<int>(100.0F * (z * lean + gate.camera_height_m));
    if (bin < 0 || bin >= bin_count || std::abs(lean) < kLeastLean) continue;
    area_per_cm[bin] += z * z / std::abs(lean);
  }
}

DEIXIS_KERNEL void GateRow(const float* __restrict row_m, const std::uint8_t* __restrict is_sound,
                           int width, const RowGate& gate, const Tops& tops,
                           std::uint8_t* __restrict is_level, std::uint8_t* __restrict is_inside) {
  constexpr std::uint8_t kOnTop = 2;
  for (int i = 0; i < tops.count; ++i) {
    const float top = tops.height_m[i] - gate.camera_height_m;
    for (int u = 0; u < width; ++u) {
      const float lean = gate.lean + gate.lean_per_px * static_cast<float>(u);
      const int is_on = static_cast<int>(std::abs(row_m[u] * lean - top) < tops.tolerance_m);
      is_level[u] = static_cast<std::uint8_t>(is_level[u] | (is_level[u] & is_on) * kOnTop);
    }
  }
  for (int u = 0; u < width; ++u) {
    is_level[u] = static_cast<std::uint8_t>(is_level[u] >> 1);
    is_inside[u] =
        static_cast<std::uint8_t>(IsInside(row_m[u], u, is_sound[u], gate) & (1 - is_level[u]));
  }
}

DEIXIS_KERNEL void LinkRow(const float* __restrict above_m, const float* __restrict row_m,
                           const std::uint8_t* __restrict above_inside,
                           const std::uint8_t* __restrict is_inside, int width, StepLimit step,
                           std::uint8_t* __restrict links) {
  for (int u = 0; u < width; ++u) {
    const int joins = is_inside[u] & above_inside[u] & IsOneSurface(row_m[u], above_m[u], step);
    links[u] = static_cast<std::uint8_t>(is_inside[u] | (joins << 2));
  }
  for (int u = 1; u < width; ++u) {
    const int joins = is_inside[u] & is_inside[u - 1] & IsOneSurface(row_m[u], row_m[u - 1], step);
    links[u] = static_cast<std::uint8_t>(links[u] | (joins << 1));
  }
}

}  // namespace deixis::pose_fitter
