#include "services/pose_fitter/core/depth/sound_depth.h"

namespace deixis::pose_fitter {

void SoundDepthConfig::Validate() const {
  config::Faults faults;
  faults.Require(step_sigmas > 0.0, "step_sigmas", "must be positive");
  faults.Require(step_slope > 0.0, "step_slope", "must be positive");
  faults.ThrowIfAny();
}

StepLimit StepLimitOf(const DepthCamera& camera, double sigmas, double slope) {
  return {static_cast<float>(sigmas * camera.noise.floor_m),
          static_cast<float>(slope / camera.focal_px.minCoeff()),
          static_cast<float>(sigmas * camera.noise.per_square_m)};
}

SoundDepth::SoundDepth(const SoundDepthConfig& config) : config_(config) { config_.Validate(); }

const std::vector<std::uint8_t>& SoundDepth::Find(const DepthView& depth) {
  const auto width = static_cast<std::size_t>(depth.width_px());
  const auto height = static_cast<std::size_t>(depth.height_px());
  nothing_m_.resize(width);
  is_sound_.resize(width * height);
  const StepLimit limit = StepLimitOf(depth.camera(), config_.step_sigmas, config_.step_slope);
  const float* z_m = depth.z_m().data();
  for (std::size_t v = 0; v < height; ++v) {
    const float* row_m = z_m + v * width;
    MarkSoundRow(v > 0 ? row_m - width : nothing_m_.data(), row_m,
                 v + 1 < height ? row_m + width : nothing_m_.data(), depth.width_px(), limit,
                 is_sound_.data() + v * width);
  }
  return is_sound_;
}

}  // namespace deixis::pose_fitter
