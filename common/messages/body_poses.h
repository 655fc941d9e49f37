#pragma once
#include <cstdint>
#include <vector>

#include "common/body_model/tracked_body.h"
#include "common/messages/codec.h"

namespace deixis::messages {

/// Decoding needs no model, so `CheckAgainst` is left to whoever uses a pose. Covariances travel in
/// single precision. Limbs go out as they are: see body_model::PlaceLimbs.
template <>
struct Codec<body_model::BodyPoses> {
  static Decoded<body_model::BodyPoses> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const body_model::BodyPoses& value,
                                          std::int64_t sequence);
  static Timestamp Time(const body_model::BodyPoses& value) { return value.time; }
};

/// Throws Rejected when the body is not one of this model: "other_model" for its id,
/// "bad_angle_count" and "bad_limb_count" when it lies about that.
void CheckAgainst(const body_model::TrackedBody& body, const body_model::BodyModel& model);

}  // namespace deixis::messages
