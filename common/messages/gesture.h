#pragma once
#include <cstdint>
#include <vector>

#include "common/messages/codec.h"
#include "common/scene/gesture.h"

namespace deixis::messages {

template <>
struct Codec<scene::Gesture> {
  static Decoded<scene::Gesture> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const scene::Gesture& value, std::int64_t sequence);
  static Timestamp Time(const scene::Gesture& value) { return value.time; }
};

}  // namespace deixis::messages
