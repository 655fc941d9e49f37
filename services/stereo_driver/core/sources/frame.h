#pragma once
#include <cstdint>
#include <optional>
#include <variant>

#include "common/capture/source.h"
#include "common/images/rgbd_image.h"
#include "common/images/stereo_pair.h"

namespace deixis::stereo_driver {

/// What was taken at one time: two pictures of a stereo camera, or colour and depth.
struct Frame {
  Timestamp time;  ///< Live: capture time. Recorded: time since the recording began.
  std::variant<images::StereoPair, images::RgbdImage> images;
  double period_s = 0.0;  ///< Nominal time to the next one; 0 = not known (live).
};

struct FrameGrab {
  capture::SourceState state = capture::SourceState::kWaiting;
  std::optional<Frame> frame;  ///< Set with kPicture only.
};

struct FrameSourceStatus {
  capture::SourceStatus pictures;    ///< Of the cameras, taken together.
  std::int64_t unmatched_left = 0;   ///< Left or colour pictures without a partner in time.
  std::int64_t unmatched_right = 0;  ///< Right or depth pictures without a partner in time.
  std::int64_t unusable = 0;         ///< Pictures that do not make a frame: sizes, odd widths.
  std::string last_unusable;         ///< Why the last of them did not; empty = by its size.
  bool is_refusing = false;          ///< The newest one did not, by what is known of the cameras.
};

/// Where frames come from that nobody sends on the bus.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// The next frame, if there is one. Never waits for a camera, and asks each for one picture at
  /// most, so that it returns however many make no frame: these yield kWaiting.
  virtual FrameGrab Next() = 0;

  virtual FrameSourceStatus status() const = 0;
};

}  // namespace deixis::stereo_driver
