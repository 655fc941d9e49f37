#include "common/capture/capture.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <opencv2/videoio.hpp>
#include <utility>

namespace deixis::capture {
namespace {

constexpr std::int64_t kOldestBuffer_us = 2'000'000;  // An older stamp is of another clock.

using SharedVideo = std::shared_ptr<cv::VideoCapture>;  // std::function wants copyable captures.

bool IsNumber(const std::string& text) {
  return std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

void AskFor(cv::VideoCapture& video, const SourceConfig& config) {
  if (!config.fourcc.empty()) {
    const std::string& code = config.fourcc;
    video.set(cv::CAP_PROP_FOURCC, cv::VideoWriter::fourcc(code[0], code[1], code[2], code[3]));
  }
  if (config.width_px > 0) video.set(cv::CAP_PROP_FRAME_WIDTH, config.width_px);
  if (config.height_px > 0) video.set(cv::CAP_PROP_FRAME_HEIGHT, config.height_px);
  if (config.rate_hz > 0.0) video.set(cv::CAP_PROP_FPS, config.rate_hz);
}

SharedVideo OpenDevice(const SourceConfig& config) {
  auto video = std::make_shared<cv::VideoCapture>();
  const std::string path = IsNumber(config.path) ? "/dev/video" + config.path : config.path;
  if (!video->open(path, cv::CAP_V4L2)) return nullptr;
  AskFor(*video, config);
  return video;
}

SharedVideo OpenUrl(const SourceConfig& config) {
  auto video = std::make_shared<cv::VideoCapture>();
  return video->open(config.path) ? video : nullptr;
}

// OpenCV's backends throw at some faults and return false at others; both mean a lost camera.
std::optional<Timestamp> TimeOfGrab(cv::VideoCapture& video,
                                    const std::function<Timestamp()>& capture_time) {
  try {
    if (!video.grab()) return std::nullopt;
    return capture_time();
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
}

// A picture that was grabbed but cannot be decoded is handed on empty and counted there.
cv::Mat Retrieve(cv::VideoCapture& video) {
  cv::Mat bgr;
  try {
    if (!video.retrieve(bgr)) return {};
  } catch (const cv::Exception&) {
    return {};
  }
  return bgr;
}

}  // namespace

ReadLive ReaderOf(std::shared_ptr<cv::VideoCapture> video,
                  std::function<Timestamp()> capture_time) {
  if (!video) return {};
  return [video = std::move(video),
          capture_time = std::move(capture_time)]() -> std::optional<LivePicture> {
    const auto time = TimeOfGrab(*video, capture_time);
    if (!time) return std::nullopt;
    return LivePicture{*time, Retrieve(*video)};
  };
}

Capture DeviceCapture(const SourceConfig& config, const Clocks& clocks) {
  const auto open = [config, clocks] {
    const SharedVideo video = OpenDevice(config);
    return ReaderOf(
        video, [video, clocks] { return CaptureTime(video->get(cv::CAP_PROP_POS_MSEC), clocks); });
  };
  return {open, "camera device '" + config.path + "'",
          "plug it in, check that you may read it (group video), or set " + config.key +
              ".path; to play a file set " + config.key + ".kind to video"};
}

Capture UrlCapture(const SourceConfig& config, const Clocks& clocks) {
  const auto open = [config, clocks] { return ReaderOf(OpenUrl(config), clocks.wall); };
  return {
      open, "camera stream '" + config.path + "'",
      "check that it is being sent and that OpenCV can read it, or set " + config.key + ".path"};
}

Timestamp CaptureTime(double buffer_ms, const Clocks& clocks) {
  const Timestamp wall = clocks.wall();
  if (!std::isfinite(buffer_ms) || buffer_ms <= 0.0) return wall;
  const std::int64_t buffer_us = std::llround(1e3 * buffer_ms);
  for (const Timestamp now : {clocks.monotonic(), wall}) {
    const std::int64_t age_us = now.microseconds - buffer_us;
    if (age_us >= 0 && age_us <= kOldestBuffer_us) return {wall.microseconds - age_us};
  }
  return wall;
}

}  // namespace deixis::capture
