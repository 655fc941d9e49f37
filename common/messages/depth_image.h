#pragma once
#include <cstdint>
#include <vector>

#include "common/images/depth_image.h"
#include "common/messages/codec.h"

namespace deixis::messages {

/// sensor_msgs.Image as dimos robots send depth: 16UC1 or mono16 in millimetres, 32FC1 in metres.
/// What was not measured, is not in front of the camera, or is beyond 65.535 m becomes 0. It is
/// published as 16UC1, and carries no sequence number.
template <>
struct Codec<images::DepthImage> {
  static Decoded<images::DepthImage> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const images::DepthImage& value, std::int64_t sequence);
  static Timestamp Time(const images::DepthImage& value) { return value.time; }
};

}  // namespace deixis::messages
