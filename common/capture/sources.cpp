#include "common/capture/sources.h"

#include <stdexcept>

#include "common/capture/capture.h"
#include "common/capture/folder_source.h"
#include "common/capture/live_source.h"
#include "common/capture/looped_source.h"
#include "common/capture/quiet_opencv.h"
#include "common/capture/video_source.h"

namespace deixis::capture {
namespace {

std::unique_ptr<Source> Open(const SourceConfig& config, const Clocks& clocks,
                             FolderContent content) {
  KeepOpenCvQuiet();
  switch (config.kind) {
    case SourceKind::kDevice:
      return std::make_unique<LiveSource>(DeviceCapture(config, clocks), clocks.monotonic);
    case SourceKind::kUrl:
      return std::make_unique<LiveSource>(UrlCapture(config, clocks), clocks.monotonic);
    case SourceKind::kVideo:
      return std::make_unique<VideoSource>(config);
    case SourceKind::kFolder:
      return std::make_unique<FolderSource>(config, content);
    case SourceKind::kDimos:
      throw config::ConfigError(config.key +
                                ".kind is dimos, whose pictures come over the bus and cannot be "
                                "opened here; set it to device, url, video or folder");
  }
  throw std::logic_error("unknown source kind");
}

}  // namespace

void SourceConfig::Check(config::Faults& faults) const {
  faults.Require(!path.empty(), key + ".path", "is empty; name a device, URL, file or folder");
  faults.Require(width_px >= 0, key + ".width_px", "must not be negative");
  faults.Require(height_px >= 0, key + ".height_px", "must not be negative");
  const bool is_rate = rate_hz >= kLowestRate_hz && rate_hz <= 1000.0;
  faults.Require(rate_hz == 0.0 || is_rate, key + ".rate_hz", "must be 0 or lie in 0.001..1000");
  faults.Require(fourcc.empty() || fourcc.size() == 4, key + ".fourcc",
                 "must be empty or four letters such as MJPG");
  faults.Require(!pattern.empty(), key + ".pattern", "is empty; '*' takes every picture");
}

void LoopableSourceConfig::Check(config::Faults& faults) const {
  SourceConfig::Check(faults);
  faults.Require(!loop || IsRecording(*this), key + ".loop", "is only for kind video and folder");
}

std::unique_ptr<Source> MakeSource(const SourceConfig& config, const Clocks& clocks) {
  return Open(config, clocks, FolderContent::kColour);
}

std::unique_ptr<Source> MakeSource(const LoopableSourceConfig& config, const Clocks& clocks) {
  const SourceConfig& once = config;
  if (!config.loop) return MakeSource(once, clocks);
  return std::make_unique<LoopedSource>([once, clocks] { return MakeSource(once, clocks); });
}

std::unique_ptr<Source> MakeDepthSource(const SourceConfig& config, const Clocks& clocks) {
  if (config.kind != SourceKind::kFolder) {
    throw config::ConfigError("depth can be read from folders only; set " + config.key +
                              ".kind to folder");
  }
  return Open(config, clocks, FolderContent::kDepth);
}

}  // namespace deixis::capture
