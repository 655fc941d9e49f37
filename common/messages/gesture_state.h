#pragma once
#include <cstdint>
#include <vector>

#include "common/messages/codec.h"
#include "common/scene/gesture.h"

namespace deixis::messages {

template <>
struct Codec<scene::GestureState> {
  static Decoded<scene::GestureState> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const scene::GestureState& value, std::int64_t sequence);
  static Timestamp Time(const scene::GestureState& value) { return value.time; }
};

}  // namespace deixis::messages
