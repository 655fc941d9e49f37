#pragma once
#include <cstdint>
#include <vector>

#include "common/geometry/camera_calibration.h"
#include "common/messages/codec.h"

namespace deixis::messages {

/// deixis.camera_calibration_t, or sensor_msgs.CameraInfo of dimos robots, told apart by
/// fingerprint (that has no sequence number; the camera's name is that of its frame). It is
/// published as the former.
template <>
struct Codec<geometry::CameraCalibration> {
  static Decoded<geometry::CameraCalibration> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const geometry::CameraCalibration& value,
                                          std::int64_t sequence);
  static Timestamp Time(const geometry::CameraCalibration& value) { return value.time; }
};

}  // namespace deixis::messages
