#pragma once
#include <cstdint>
#include <vector>

#include "common/geometry/stereo_calibration.h"
#include "common/messages/codec.h"

namespace deixis::messages {

/// deixis.stereo_calibration_t. What is no calibration (sizes, focal lengths, rotations) is
/// rejected as `out_of_range`.
template <>
struct Codec<geometry::StereoCalibration> {
  static Decoded<geometry::StereoCalibration> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const geometry::StereoCalibration& value,
                                          std::int64_t sequence);
  static Timestamp Time(const geometry::StereoCalibration& value) { return value.time; }
};

}  // namespace deixis::messages
