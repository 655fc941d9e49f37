#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/capture/clocks.h"
#include "common/capture/source.h"
#include "common/config/config.h"

namespace deixis::capture {

enum class SourceKind { kDevice, kUrl, kVideo, kFolder, kDimos };

inline auto EnumNames(SourceKind) {
  return std::vector<std::pair<std::string, SourceKind>>{{"device", SourceKind::kDevice},
                                                         {"url", SourceKind::kUrl},
                                                         {"video", SourceKind::kVideo},
                                                         {"folder", SourceKind::kFolder},
                                                         {"dimos", SourceKind::kDimos}};
}

/// Slower recordings are none.
inline constexpr double kLowestRate_hz = 0.001;

struct SourceConfig {
  SourceKind kind = SourceKind::kDevice;  ///< What `path` is.
  std::string path = "0";  ///< Device number or /dev/videoN, URL or GStreamer text, file, folder.
  int width_px = 640;      ///< Asked of a device; it may give another size. 0 = its own choice.
  int height_px = 480;     ///< Asked of a device. 0 = its own choice.
  double rate_hz = 0.0;  ///< Device: asked of it. Recordings: replaces their times. 0 = their own.
  std::string fourcc;  ///< Pixel format asked of a device: "MJPG", "YUYV". Empty = its own choice.
  std::string pattern = "*";  ///< Folder: which file names, as a shell would match them.
  /// Where this stands in the configuration, for messages; not a setting.
  std::string key = "source";

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("kind", kind);
    v("path", path);
    v("width_px", width_px);
    v("height_px", height_px);
    v("rate_hz", rate_hz);
    v("fourcc", fourcc);
    v("pattern", pattern);
  }
  void Check(config::Faults& faults) const;  ///< Notes what is wrong under "<key>.<setting>".
};

inline bool IsRecording(const SourceConfig& config) {
  return config.kind == SourceKind::kVideo || config.kind == SourceKind::kFolder;
}

/// A source on its own, which nothing keeps from beginning again.
struct LoopableSourceConfig : SourceConfig {
  bool loop = false;  ///< Recordings: begin again at the end; time goes on.

  template <typename Visitor>
  void Visit(Visitor& v) {
    SourceConfig::Visit(v);
    v("loop", loop);
  }
  void Check(config::Faults& faults) const;
};

/// Opens what `config` names: the one place that knows all kinds of sources. Throws ConfigError,
/// with the cure, when it cannot be opened, as pictures of a dimos robot cannot: they come over the
/// bus, to which services subscribe.
std::unique_ptr<Source> MakeSource(const SourceConfig& config, const Clocks& clocks);
std::unique_ptr<Source> MakeSource(const LoopableSourceConfig& config, const Clocks& clocks);

/// The same for a folder of 16-bit depth pictures: Picture::depth is set, not Picture::bgr.
std::unique_ptr<Source> MakeDepthSource(const SourceConfig& config, const Clocks& clocks);

}  // namespace deixis::capture
