#include "services/stereo_driver/core/sources/sources.h"

#include <stdexcept>

#include "services/stereo_driver/core/sources/looped_frame_source.h"
#include "services/stereo_driver/core/sources/matched_source.h"
#include "services/stereo_driver/core/sources/side_by_side_source.h"

namespace deixis::stereo_driver {
namespace {

capture::SourceConfig Defaults(const std::string& key, const std::string& path) {
  capture::SourceConfig config;
  config.key = key;
  config.path = path;
  return config;
}

bool IsPlayed(const FrameSourceConfig& config) {
  const bool is_received = ComesFromBus(config.kind) || config.kind == FrameSourceKind::kDimos;
  return !is_received && capture::IsRecording(config.left);
}

void CheckColourAndDepth(const FrameSourceConfig& config, config::Faults& faults) {
  faults.Require(config.left.kind == capture::SourceKind::kFolder, "source.left.kind",
                 "must be folder for source.kind colour_and_depth");
  faults.Require(config.right.kind == capture::SourceKind::kFolder, "source.right.kind",
                 "must be folder for source.kind colour_and_depth");
}

struct TwoSources {
  std::unique_ptr<capture::Source> left;
  std::unique_ptr<capture::Source> right;
};

/// Throws ConfigError that names both when neither can be opened.
TwoSources OpenBoth(const FrameSourceConfig& config, const capture::Clocks& clocks) {
  std::string faults;
  const auto open = [&](const capture::SourceConfig& source) {
    try {
      return capture::MakeSource(source, clocks);
    } catch (const config::ConfigError& error) {
      faults += (faults.empty() ? "" : "; ") + std::string(error.what());
      return std::unique_ptr<capture::Source>();
    }
  };
  TwoSources both;
  both.left = open(config.left);
  both.right = open(config.right);
  if (!faults.empty()) throw config::ConfigError(faults);
  return both;
}

std::unique_ptr<FrameSource> OpenTwoCameras(const FrameSourceConfig& config,
                                            const capture::Clocks& clocks) {
  TwoSources both = OpenBoth(config, clocks);
  return std::make_unique<MatchedSource>(std::move(both.left), std::move(both.right),
                                         config.max_skew_s, ComposePair);
}

std::unique_ptr<FrameSource> OpenOnce(const FrameSourceConfig& config,
                                      const capture::Clocks& clocks) {
  const double unit_mm = config.depth_unit_mm;
  switch (config.kind) {
    case FrameSourceKind::kTwoCameras:
      return OpenTwoCameras(config, clocks);
    case FrameSourceKind::kSideBySide:
      return std::make_unique<SideBySideSource>(
          capture::MakeSource(config.left, clocks),
          config.is_left_on_right ? LeftHalf::kRight : LeftHalf::kLeft);
    case FrameSourceKind::kColourAndDepth:
      return std::make_unique<MatchedSource>(
          capture::MakeSource(config.left, clocks), capture::MakeDepthSource(config.right, clocks),
          config.max_skew_s,
          [unit_mm](const capture::Picture& colour, const capture::Picture& depth) {
            return ComposeColourAndDepth(colour, depth, unit_mm);
          });
    case FrameSourceKind::kPairChannel:
    case FrameSourceKind::kKinectChannel:
    case FrameSourceKind::kDimos:
      return nullptr;
  }
  throw std::logic_error("unknown kind of frame source");
}

}  // namespace

bool ComesFromBus(FrameSourceKind kind) {
  return kind == FrameSourceKind::kPairChannel || kind == FrameSourceKind::kKinectChannel;
}

capture::SourceConfig LeftSourceDefaults() { return Defaults("source.left", "0"); }
capture::SourceConfig RightSourceDefaults() { return Defaults("source.right", "2"); }

void FrameSourceConfig::Check(config::Faults& faults) const {
  faults.Require(max_skew_s >= 0.0 && max_skew_s <= 1.0, "source.max_skew_s",
                 "must lie in 0..1 seconds");
  faults.Require(depth_unit_mm > 0.0 && depth_unit_mm <= 1000.0, "source.depth_unit_mm",
                 "must be positive, 1000 at most");
  left.Check(faults);
  right.Check(faults);
  faults.Require(!loop || IsPlayed(*this), "source.loop",
                 "is only for recordings: source.left.kind video or folder");
  if (kind == FrameSourceKind::kColourAndDepth) CheckColourAndDepth(*this, faults);
  const bool are_both = capture::IsRecording(left) == capture::IsRecording(right);
  faults.Require(kind != FrameSourceKind::kTwoCameras || are_both, "source.right.kind",
                 "must be a recording when source.left is one, and live when that is live");
}

std::unique_ptr<FrameSource> MakeFrameSource(const FrameSourceConfig& config,
                                             const capture::Clocks& clocks) {
  if (!config.loop) return OpenOnce(config, clocks);
  return std::make_unique<LoopedFrameSource>([config, clocks] { return OpenOnce(config, clocks); });
}

}  // namespace deixis::stereo_driver
