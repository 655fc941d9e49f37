#pragma once
#include <cstdint>
#include <vector>

#include "common/config/config.h"
#include "services/pose_fitter/core/depth/depth_kernels.h"
#include "services/pose_fitter/core/depth/depth_view.h"

namespace deixis::pose_fitter {

struct SoundDepthConfig {
  double step_sigmas = 3.0;  ///< Noise of a depth that is no step yet.
  double step_slope = 8.0;   ///< Steepest surface: depth per width of a pixel (8 = 83 degrees).

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("step_sigmas", step_sigmas);
    v("step_slope", step_slope);
  }
  void Validate() const;
};

/// Tells depth that was measured on a surface from what cameras make up at edges: flying pixels
/// between front and back, and spurs one pixel wide. What lies on a slope of less than `step_slope`
/// stays.
class SoundDepth {
 public:
  explicit SoundDepth(const SoundDepthConfig& config = {});

  /// Per pixel, row by row: 1 = to be trusted, 0 = not, or not measured. Valid until the next call.
  const std::vector<std::uint8_t>& Find(const DepthView& depth);

 private:
  SoundDepthConfig config_;
  std::vector<float> nothing_m_;  ///< The rows beyond the image.
  std::vector<std::uint8_t> is_sound_;
};

/// The step between neighbours that `sigmas` of noise and a surface of `slope` make.
StepLimit StepLimitOf(const DepthCamera& camera, double sigmas, double slope);

}  // namespace deixis::pose_fitter
