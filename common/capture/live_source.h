#pragma once
#include <functional>
#include <memory>

#include "common/capture/capture.h"

namespace deixis::capture {

/// A camera or stream, read by a thread of its own, since reading a dead camera may block for
/// seconds. The newest picture is kept; one that nobody asked for in time is counted as skipped. A
/// lost camera is opened again after 1, 2, 4 ... 30 s.
class LiveSource final : public Source {
 public:
  /// Opens the camera; throws ConfigError with the cure when it is not there. By
  /// `monotonic_clock` it tells that the camera is silent, whatever the capture times do.
  LiveSource(Capture capture, std::function<Timestamp()> monotonic_clock);
  /// Leaves a reading thread that hangs in a dead camera behind rather than wait for it.
  ~LiveSource() override;
  LiveSource(const LiveSource&) = delete;
  LiveSource& operator=(const LiveSource&) = delete;

  Grab Next() override;
  SourceStatus status() const override;

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;  ///< Of this and the reading thread, whichever lives longer.
};

}  // namespace deixis::capture
