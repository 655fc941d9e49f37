#pragma once
#include <cstdint>
#include <vector>

#include "common/messages/codec.h"
#include "common/scene/object.h"

namespace deixis::messages {

template <>
struct Codec<scene::Objects> {
  static Decoded<scene::Objects> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const scene::Objects& value, std::int64_t sequence);
  static Timestamp Time(const scene::Objects& value) { return value.time; }
};

}  // namespace deixis::messages
