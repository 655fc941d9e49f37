#include "common/messages/camera_pose.h"

#include <bot_core/rigid_transform_t.hpp>

#include "common/messages/geometry_parts.h"

namespace deixis::messages {

using bot_core::rigid_transform_t;
using geometry::CameraPose;

Decoded<CameraPose> Codec<CameraPose>::Decode(Bytes bytes) {
  const auto message = DecodeWire<rigid_transform_t>(bytes);
  return {{ToTimestamp(message.utime), ToTransform(message.trans, message.quat)}, -1};
}

std::vector<std::uint8_t> Codec<CameraPose>::Encode(const CameraPose& pose, std::int64_t) {
  rigid_transform_t message{};
  message.utime = pose.time.microseconds;
  FromTransform(pose.parent_from_camera, message.trans, message.quat);
  return EncodeWire(message);
}

}  // namespace deixis::messages
