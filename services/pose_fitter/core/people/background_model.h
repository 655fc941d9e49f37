#pragma once
#include <cstdint>
#include <vector>

#include "common/config/config.h"
#include "services/pose_fitter/core/depth/depth_view.h"
#include "services/pose_fitter/core/people/background_kernels.h"

namespace deixis::pose_fitter {

struct BackgroundModelConfig {
  bool is_used = true;          ///< A camera that moves is noticed: everything is forgotten.
  double still_time_s = 3.0;    ///< What is seen for so long is background,
  double nearer_time_s = 60.0;  ///< and what comes before it, for so long.
  double same_fixed_m = 0.02;   ///< The same surface may be off by this
  double same_sigmas = 3.0;     ///< and by so much of its noise.
  double moving_share = 0.6;    ///< Share of different pixels from which the camera itself moves.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("is_used", is_used);
    v("still_time_s", still_time_s);
    v("nearer_time_s", nearer_time_s);
    v("same_fixed_m", same_fixed_m);
    v("same_sigmas", same_sigmas);
    v("moving_share", moving_share);
  }
  void Validate() const;
};

/// The room without people, as a camera that stands still sees it: how far away each pixel is when
/// nobody stands before it. Sets people apart from furniture that they touch. Who stays where he
/// was at the start, and is not said to be occupied, becomes background; when he leaves, what
/// is behind him replaces him within `still_time_s`. Takes its memory once per size.
class BackgroundModel {
 public:
  explicit BackgroundModel(const BackgroundModelConfig& config = {});

  /// Sound pixels that are not background, 1 each: what to pass on instead of `is_sound`; all of
  /// these when it is not used, or not known yet. Forgets everything when the camera moves. Valid
  /// until the next call.
  const std::vector<std::uint8_t>& Foreground(const DepthView& depth,
                                              const std::vector<std::uint8_t>& is_sound);
  /// Learns from the image of the last Foreground(). `is_occupied`: per pixel, not 0 where a person
  /// is known to be; empty = nowhere. `elapsed_s`: since the last image.
  void Learn(const DepthView& depth, const std::vector<std::uint8_t>& is_sound,
             const std::vector<std::uint8_t>& is_occupied, double elapsed_s);

  void Reset();
  /// Share of the pixels whose background is known, 0..1; of the last Foreground().
  double known_share() const { return known_share_; }

 private:
  BackgroundRule RuleOf(const DepthCamera& camera, double elapsed_s) const;
  void Fit(const DepthView& depth);

  BackgroundModelConfig config_;
  double known_share_ = 0.0;
  int width_px_ = 0;
  std::vector<float> background_m_, seen_s_, other_s_;
  std::vector<std::uint8_t> is_foreground_;
};

}  // namespace deixis::pose_fitter
