#pragma once
#include <cstdint>
#include <vector>

#include "common/body_model/tracked_body.h"
#include "common/messages/codec.h"

namespace deixis::messages {

/// Numbers of the model pass bit for bit, so that its id stays. What algorithms add to limbs
/// (`extras`) is not taken over.
template <>
struct Codec<body_model::PersonModel> {
  static Decoded<body_model::PersonModel> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const body_model::PersonModel& value,
                                          std::int64_t sequence);
  static Timestamp Time(const body_model::PersonModel& value) { return value.time; }
};

}  // namespace deixis::messages
