#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "common/capture/clocks.h"
#include "common/capture/sources.h"

namespace cv {
class VideoCapture;
}

namespace deixis::capture {

/// One picture of an open camera with its capture time.
struct LivePicture {
  Timestamp time;
  cv::Mat bgr;
};

/// Waits for the next picture of an open camera; nothing = the camera is lost.
using ReadLive = std::function<std::optional<LivePicture>()>;

/// A camera that can be opened, and opened again after it was lost.
struct Capture {
  std::function<ReadLive()> open;               ///< An empty function = it cannot be opened now.
  std::string name;                             ///< For messages: "camera device '/dev/video0'".
  std::string cure;                             ///< What to do when it cannot be opened.
  std::chrono::milliseconds first_retry{1000};  ///< Doubled with every try that fails, up to 30 s.
};

/// Reads an open `video` (empty = not open: gives an empty function). Neither a camera that OpenCV
/// throws away nor a picture that it cannot decode throws: the one is lost, the other empty.
ReadLive ReaderOf(std::shared_ptr<cv::VideoCapture> video, std::function<Timestamp()> capture_time);

Capture DeviceCapture(const SourceConfig& config, const Clocks& clocks);
Capture UrlCapture(const SourceConfig& config, const Clocks& clocks);

/// Wall-clock time of a capture whose driver stamped it with `buffer_ms`. V4L2 drivers stamp with
/// CLOCK_MONOTONIC, some with the wall clock; a stamp that fits neither, or none (0), yields now.
Timestamp CaptureTime(double buffer_ms, const Clocks& clocks);

}  // namespace deixis::capture
