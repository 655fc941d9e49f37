#pragma once
#include <cstdint>
#include <vector>

#include "common/geometry/frame_transform.h"
#include "common/messages/codec.h"

namespace deixis::messages {

/// tf2_msgs.TFMessage, as dimos robots say where their frames are. It carries no sequence number.
template <>
struct Codec<geometry::FrameTransforms> {
  static Decoded<geometry::FrameTransforms> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const geometry::FrameTransforms& value,
                                          std::int64_t sequence);
  /// None: many publish on one channel, each for its own times, so that these go to and fro.
  static Timestamp Time(const geometry::FrameTransforms&) { return {}; }
};

}  // namespace deixis::messages
