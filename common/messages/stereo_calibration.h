#pragma once
#include <cstdint>
#include <vector>

#include "common/geometry/stereo_calibration.h"
#include "common/messages/codec.h"

namespace deixis::messages {

template <>
struct Codec<geometry::StereoCalibration> {
  static Decoded<geometry::StereoCalibration> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const geometry::StereoCalibration& value,
                                          std::int64_t sequence);
  static Timestamp Time(const geometry::StereoCalibration& value) { return value.time; }
};

}  // namespace deixis::messages
