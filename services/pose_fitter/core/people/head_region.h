#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "services/pose_fitter/core/depth/depth_kernels.h"
#include "services/pose_fitter/core/depth/depth_view.h"
#include "services/pose_fitter/core/people/head_shapes.h"

namespace deixis::pose_fitter {

/// How far the body of a head reaches.
struct HeadReach {
  double beside_m = 0.0;  ///< Of the head's vertical,
  double depth_m = 0.0;   ///< of its depth, either way,
  double above_m = 0.0;   ///< above its middle: lifted arms;
  double below_m = 0.0;   ///< and below it.
  StepLimit step;         ///< Within one surface.
};

/// What is connected with a head, as far as a body reaches: where people are one surface with what
/// they sit on or stand at. Takes its memory once per size.
class HeadRegion {
 public:
  /// Pixels of `labels` that are 0 and connected with the head's middle, which is one of them.
  /// `up`: against gravity, in the camera's frame. Valid until the next call.
  const std::vector<int>& Find(const DepthView& depth, const std::vector<std::uint8_t>& is_sound,
                               const std::vector<std::uint8_t>& labels, const HeadShape& head,
                               const Eigen::Vector3d& up, const HeadReach& reach);

 private:
  std::vector<std::uint8_t> is_in_;
  std::vector<int> pixels_;
};

}  // namespace deixis::pose_fitter
