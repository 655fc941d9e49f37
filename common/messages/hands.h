#pragma once
#include <cstdint>
#include <vector>

#include "common/messages/codec.h"
#include "common/scene/hand.h"

namespace deixis::messages {

template <>
struct Codec<scene::Hands> {
  static Decoded<scene::Hands> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const scene::Hands& value, std::int64_t sequence);
  static Timestamp Time(const scene::Hands& value) { return value.time; }
};

}  // namespace deixis::messages
