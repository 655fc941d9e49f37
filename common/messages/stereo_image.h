#pragma once
#include <cstdint>
#include <vector>

#include "common/images/stereo_image.h"
#include "common/messages/codec.h"

namespace deixis::messages {

/// bot_core.images_t with LEFT (a JPEG file) and DEPTH_MM_ZIPPED; a DEPTH_MM that is not packed is
/// taken as well.
template <>
struct Codec<images::StereoImage> {
  static Decoded<images::StereoImage> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const images::StereoImage& value, std::int64_t sequence);
  static Timestamp Time(const images::StereoImage& value) { return value.left.time; }
};

}  // namespace deixis::messages
