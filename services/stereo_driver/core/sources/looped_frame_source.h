#pragma once
#include <functional>
#include <memory>

#include "common/capture/rounds.h"
#include "services/stereo_driver/core/sources/frame.h"

namespace deixis::stereo_driver {

/// Recordings without end: when one of them is over, all are opened again, so that what was taken
/// together stays together, whatever the lengths. Time goes on, one period after the last frame.
class LoopedFrameSource final : public FrameSource {
 public:
  explicit LoopedFrameSource(std::function<std::unique_ptr<FrameSource>()> open);

  FrameGrab Next() override;  ///< kFinished only when a round gave no frame, or time is up (2^59).
  FrameSourceStatus status() const override;

 private:
  void BeginNextRound();

  std::function<std::unique_ptr<FrameSource>()> open_;
  std::unique_ptr<FrameSource> source_;
  FrameSourceStatus before_;  ///< What the earlier rounds have counted.
  capture::Rounds rounds_;
};

}  // namespace deixis::stereo_driver
