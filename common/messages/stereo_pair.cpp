#include "common/messages/stereo_pair.h"

#include <utility>

#include "common/messages/image_parts.h"
#include "common/messages/wire.h"

namespace deixis::messages {
namespace {

using bot_core::image_t;
using bot_core::images_t;
using images::EncodedStereoPair;
using images::StereoPair;

struct PairOfImages {
  const image_t& left;
  const image_t& right;
};

// Sizes are compared before anything is decoded.
PairOfImages RequirePair(const images_t& message) {
  const PairOfImages pair{RequireImage(message, images_t::LEFT, "no_left_image"),
                          RequireImage(message, images_t::RIGHT, "no_right_image")};
  if (pair.left.width != pair.right.width || pair.left.height != pair.right.height) {
    throw Rejected("pair_of_two_sizes");
  }
  return pair;
}

std::vector<std::uint8_t> EncodePair(image_t left, image_t right, Timestamp time) {
  images_t message{};
  message.utime = time.microseconds;
  message.image_types = {images_t::LEFT, images_t::RIGHT};
  message.images.push_back(std::move(left));
  message.images.push_back(std::move(right));
  message.n_images = static_cast<std::int32_t>(message.images.size());
  return EncodeWire(message);
}

}  // namespace

Decoded<StereoPair> Codec<StereoPair>::Decode(Bytes bytes) {
  const auto message = DecodeWire<images_t>(bytes);
  const auto [left, right] = RequirePair(message);
  StereoPair pair{ToImage(left), ToImage(right)};
  pair.left.time = pair.right.time = ToTimestamp(message.utime);
  return {std::move(pair), SequenceOf(left)};
}

std::vector<std::uint8_t> Codec<StereoPair>::Encode(const StereoPair& pair, std::int64_t sequence) {
  return EncodePair(FromImage(pair.left, sequence), FromImage(pair.right, sequence),
                    pair.left.time);
}

Decoded<EncodedStereoPair> Codec<EncodedStereoPair>::Decode(Bytes bytes) {
  const auto message = DecodeWire<images_t>(bytes);
  const auto [left, right] = RequirePair(message);
  EncodedStereoPair pair{ToEncodedImage(left), ToEncodedImage(right)};
  pair.left.time = pair.right.time = ToTimestamp(message.utime);
  return {std::move(pair), SequenceOf(left)};
}

std::vector<std::uint8_t> Codec<EncodedStereoPair>::Encode(const EncodedStereoPair& pair,
                                                           std::int64_t sequence) {
  return EncodePair(FromEncodedImage(pair.left, sequence), FromEncodedImage(pair.right, sequence),
                    pair.left.time);
}

}  // namespace deixis::messages
