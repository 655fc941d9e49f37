#pragma once
#include <cstdint>
#include <vector>

#include "common/images/rgbd_image.h"
#include "common/messages/codec.h"

namespace deixis::messages {

/// kinect.frame_msg_t: colour as RGB, JPEG, Bayer, UYVY or 8-bit infrared; depth as millimetres
/// (registered to the colour camera or not) or as the sensor's own 11 bits, packed by zlib or not.
/// It carries no sequence number. It is published as RGB and registered millimetres, packed.
template <>
struct Codec<images::RgbdImage> {
  static Decoded<images::RgbdImage> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const images::RgbdImage& value, std::int64_t sequence);
  static Timestamp Time(const images::RgbdImage& value) { return value.colour.time; }
};

}  // namespace deixis::messages
