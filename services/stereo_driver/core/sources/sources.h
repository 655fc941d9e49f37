#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/capture/sources.h"
#include "common/config/config.h"
#include "services/stereo_driver/core/sources/frame.h"

namespace deixis::stereo_driver {

enum class FrameSourceKind {
  kTwoCameras,      ///< `left` and `right`, paired by time.
  kSideBySide,      ///< `left` alone; each picture holds both views.
  kColourAndDepth,  ///< `left` is colour, `right` a folder of 16-bit depth pictures.
  kPairChannel,     ///< STEREO_PAIR from the bus: a recorded pair is matched again.
  kKinectChannel,   ///< kinect.frame_msg_t from the bus.
  kDimos            ///< Colour, depth and lens of a dimos robot, from the bus.
};

inline auto EnumNames(FrameSourceKind) {
  return std::vector<std::pair<std::string, FrameSourceKind>>{
      {"two_cameras", FrameSourceKind::kTwoCameras},
      {"side_by_side", FrameSourceKind::kSideBySide},
      {"colour_and_depth", FrameSourceKind::kColourAndDepth},
      {"pair_channel", FrameSourceKind::kPairChannel},
      {"kinect_channel", FrameSourceKind::kKinectChannel},
      {"dimos", FrameSourceKind::kDimos}};
}

/// Whether frames of that kind are sent by others, whole.
bool ComesFromBus(FrameSourceKind kind);

capture::SourceConfig LeftSourceDefaults();
capture::SourceConfig RightSourceDefaults();

struct FrameSourceConfig {
  FrameSourceKind kind = FrameSourceKind::kTwoCameras;  ///< What the frames are made of.
  capture::SourceConfig left = LeftSourceDefaults();    ///< Left or only camera, or colour.
  capture::SourceConfig right = RightSourceDefaults();  ///< Right camera, or depth.
  bool loop = false;              ///< Recordings: begin again at the end of either; time goes on.
  double max_skew_s = 0.010;      ///< Pictures further apart are no pair; below half the period.
  bool is_left_on_right = false;  ///< Side by side: the left camera's view is the right half.
  double depth_unit_mm = 1.0;     ///< Colour and depth: what one step of the 16 bits means.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("kind", kind);
    v("left", left);
    v("right", right);
    v("loop", loop);
    v("max_skew_s", max_skew_s);
    v("is_left_on_right", is_left_on_right);
    v("depth_unit_mm", depth_unit_mm);
  }
  void Check(config::Faults& faults) const;
};

/// Opens what `config` names. nullptr when the frames come from the bus, whole; of a dimos robot
/// see DimosSource. Throws ConfigError, with the cure, when something cannot be opened.
std::unique_ptr<FrameSource> MakeFrameSource(const FrameSourceConfig& config,
                                             const capture::Clocks& clocks);

}  // namespace deixis::stereo_driver
