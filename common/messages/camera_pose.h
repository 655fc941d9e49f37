#pragma once
#include <cstdint>
#include <vector>

#include "common/geometry/camera_pose.h"
#include "common/messages/codec.h"

namespace deixis::messages {

/// bot_core.rigid_transform_t, which carries no sequence number.
template <>
struct Codec<geometry::CameraPose> {
  static Decoded<geometry::CameraPose> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const geometry::CameraPose& value, std::int64_t sequence);
  static Timestamp Time(const geometry::CameraPose& value) { return value.time; }
};

}  // namespace deixis::messages
