#include "services/pose_fitter/core/people/head_region.h"

#include <cmath>
#include <cstddef>

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector3d;

bool IsWithin(const Vector3d& from_head_m, const Vector3d& up, const HeadReach& reach) {
  const double above_m = up.dot(from_head_m);
  const Vector3d right = Vector3d::UnitZ().cross(up);
  return above_m < reach.above_m && above_m > -reach.below_m &&
         std::abs(right.dot(from_head_m)) < reach.beside_m &&
         std::abs(from_head_m.z()) < reach.depth_m;
}

bool IsOneSurface(float z, float other, StepLimit step) {
  return std::abs(z - other) < step.fixed_m + z * (step.per_m + z * step.per_square_m);
}

}  // namespace

const std::vector<int>& HeadRegion::Find(const DepthView& depth,
                                         const std::vector<std::uint8_t>& is_sound,
                                         const std::vector<std::uint8_t>& labels,
                                         const HeadShape& head, const Vector3d& up,
                                         const HeadReach& reach) {
  const int width = depth.width_px();
  pixels_.reserve(depth.z_m().size());
  is_in_.assign(depth.z_m().size(), 0);
  pixels_.assign(1, head.v_px * width + head.u_px);
  is_in_[static_cast<std::size_t>(pixels_.front())] = 1;
  for (std::size_t next = 0; next < pixels_.size(); ++next) {
    const int u = pixels_[next] % width, v = pixels_[next] / width;
    for (const auto& [du, dv] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
      const int at_u = u + du, at_v = v + dv;
      if (at_u < 0 || at_v < 0 || at_u >= width || at_v >= depth.height_px()) continue;
      const auto at = static_cast<std::size_t>(at_v * width + at_u);
      if (is_in_[at] != 0 || is_sound[at] == 0 || labels[at] != 0 ||
          !IsOneSurface(depth.z_m(u, v), depth.z_m(at_u, at_v), reach.step) ||
          !IsWithin(depth.Point(at_u, at_v) - head.middle_m, up, reach)) {
        continue;
      }
      is_in_[at] = 1;
      pixels_.push_back(static_cast<int>(at));
    }
  }
  return pixels_;
}

}  // namespace deixis::pose_fitter
