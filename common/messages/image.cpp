#include "common/messages/image.h"

#include <utility>

#include "common/messages/dimos_parts.h"
#include "common/messages/image_parts.h"
#include "common/messages/wire.h"

namespace deixis::messages {
namespace {

using bot_core::image_t;
using bot_core::images_t;
using images::EncodedImage;
using images::Image;

Decoded<Image> Numbered(const image_t& message) { return {ToImage(message), SequenceOf(message)}; }

// The time of all pictures in it, as other codecs of it have it.
Decoded<Image> LeftOf(const images_t& message) {
  Decoded<Image> left = Numbered(RequireImage(message, images_t::LEFT, "no_left_image"));
  left.value.time = ToTimestamp(message.utime);
  return left;
}

}  // namespace

Decoded<EncodedImage> Codec<EncodedImage>::Decode(Bytes bytes) {
  auto message = DecodeWire<image_t>(bytes);
  const std::int64_t sequence = SequenceOf(message);
  return {ToEncodedImage(std::move(message)), sequence};
}

std::vector<std::uint8_t> Codec<EncodedImage>::Encode(const EncodedImage& image,
                                                      std::int64_t sequence) {
  return EncodeWire(FromEncodedImage(image, sequence));
}

Decoded<Image> Codec<Image>::Decode(Bytes bytes) {
  const std::int64_t fingerprint = Fingerprint(bytes);
  if (fingerprint == images_t::getHash()) {
    return LeftOf(DecodeWire<images_t>(bytes));
  }
  if (fingerprint == sensor_msgs::Image::getHash()) {
    return {ToImage(DecodeWire<sensor_msgs::Image>(bytes)), -1};
  }
  if (fingerprint == sensor_msgs::CompressedImage::getHash()) {
    return {ToImage(DecodeWire<sensor_msgs::CompressedImage>(bytes)), -1};
  }
  return Numbered(DecodeWire<image_t>(bytes));
}

std::vector<std::uint8_t> Codec<Image>::Encode(const Image& image, std::int64_t sequence) {
  return EncodeWire(FromImage(image, sequence));
}

}  // namespace deixis::messages
