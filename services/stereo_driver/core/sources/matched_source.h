#pragma once
#include <functional>
#include <memory>

#include "common/capture/paired_sources.h"
#include "services/stereo_driver/core/sources/frame.h"

namespace deixis::stereo_driver {

/// Two sources of pictures whose pictures are paired by time.
class MatchedSource final : public FrameSource {
 public:
  /// Makes a frame of two pictures; nothing when they do not go together.
  using Compose = std::function<std::optional<Frame>(const capture::Picture& left,
                                                     const capture::Picture& right)>;

  MatchedSource(std::unique_ptr<capture::Source> left, std::unique_ptr<capture::Source> right,
                double max_skew_s, Compose compose);

  FrameGrab Next() override;
  FrameSourceStatus status() const override;

 private:
  capture::PairedSources sources_;
  Compose compose_;
  std::int64_t unusable_ = 0;
};

/// Two pictures of one size as a stereo pair; the left one's time is the frame's.
std::optional<Frame> ComposePair(const capture::Picture& left, const capture::Picture& right);

/// Colour and 16-bit depth, whose values count `depth_unit_mm` each.
std::optional<Frame> ComposeColourAndDepth(const capture::Picture& colour,
                                           const capture::Picture& depth, double depth_unit_mm);

}  // namespace deixis::stereo_driver
