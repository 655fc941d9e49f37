#pragma once
#include <cstdint>
#include <vector>

#include "common/images/encoded_image.h"
#include "common/images/image.h"
#include "common/messages/codec.h"

namespace deixis::messages {

/// bot_core.image_t with a JPEG in it. Camera name and sequence travel as metadata `deixis.camera`
/// and `deixis.sequence`.
template <>
struct Codec<images::EncodedImage> {
  static Decoded<images::EncodedImage> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const images::EncodedImage& value, std::int64_t sequence);
  static Timestamp Time(const images::EncodedImage& value) { return value.time; }
};

/// Any picture of a bus: bot_core.image_t as MJPEG, BGR, RGB, grey or YUYV, the LEFT picture of a
/// bot_core.images_t, or what dimos robots send: sensor_msgs.Image (rgb8, bgr8, rgba8, bgra8,
/// mono8, yuv422, yuv422_yuy2, jpeg), sensor_msgs.CompressedImage (jpeg). They are told apart by
/// fingerprint. Those of dimos have no sequence number, and the frame's name as that of the camera.
/// It is published as raw BGR.
template <>
struct Codec<images::Image> {
  static Decoded<images::Image> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const images::Image& value, std::int64_t sequence);
  static Timestamp Time(const images::Image& value) { return value.time; }
};

}  // namespace deixis::messages
