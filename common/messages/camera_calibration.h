#pragma once
#include <cstdint>
#include <vector>

#include "common/geometry/camera_calibration.h"
#include "common/messages/codec.h"

namespace deixis::messages {

/// What is known of a picture's lens: deixis.camera_calibration_t; of deixis.stereo_calibration_t
/// the rectified camera, whose picture is the published LEFT; or sensor_msgs.CameraInfo of dimos
/// robots (without a sequence number; the camera's name is that of its frame). They are told apart
/// by fingerprint. It is published as the first.
template <>
struct Codec<geometry::CameraCalibration> {
  static Decoded<geometry::CameraCalibration> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const geometry::CameraCalibration& value,
                                          std::int64_t sequence);
  static Timestamp Time(const geometry::CameraCalibration& value) { return value.time; }
};

}  // namespace deixis::messages
