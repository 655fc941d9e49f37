#pragma once
#include <cstdint>
#include <vector>

#include "common/images/stereo_pair.h"
#include "common/messages/codec.h"

namespace deixis::messages {

/// bot_core.images_t with LEFT and RIGHT as two cameras gave them: MJPEG, BGR, RGB, grey or YUYV.
/// It is published as raw BGR.
template <>
struct Codec<images::StereoPair> {
  static Decoded<images::StereoPair> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const images::StereoPair& value, std::int64_t sequence);
  static Timestamp Time(const images::StereoPair& value) { return value.left.time; }
};

/// The same as two JPEG files.
template <>
struct Codec<images::EncodedStereoPair> {
  static Decoded<images::EncodedStereoPair> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const images::EncodedStereoPair& value,
                                          std::int64_t sequence);
  static Timestamp Time(const images::EncodedStereoPair& value) { return value.left.time; }
};

}  // namespace deixis::messages
