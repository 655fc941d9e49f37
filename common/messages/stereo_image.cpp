#include "common/messages/stereo_image.h"

#include <opencv2/core.hpp>
#include <utility>

#include "common/messages/image_parts.h"
#include "common/messages/inflate.h"
#include "common/messages/wire.h"

namespace deixis::messages {
namespace {

using bot_core::image_t;
using bot_core::images_t;
using images::StereoImage;

// Fast: a smaller file would cost several times the time at 640x480.
constexpr int kDepthCompression = 1;

void RequireSameView(const image_t& left, const image_t& depth) {
  const cv::Size picture(left.width, left.height);
  if (!images::MayCoverSameView({depth.width, depth.height}, picture)) {
    throw Rejected("depth_of_other_view");
  }
}

cv::Mat FromRows(const std::vector<std::uint8_t>& rows, cv::Size size, std::int64_t stride) {
  return RawPixels(rows, size, CV_16UC1, stride).clone();
}

cv::Mat InflatedDepth(const image_t& message) {
  const auto row = static_cast<std::size_t>(message.width) * 2;
  if (message.row_stride != 0 && static_cast<std::size_t>(message.row_stride) != row) {
    throw Rejected("bad_row_stride");
  }
  const std::size_t expected = row * static_cast<std::size_t>(message.height);
  const cv::Size size(message.width, message.height);
  return FromRows(InflateExactly({message.data.data(), message.data.size()}, expected), size, 0);
}

cv::Mat ToDepth(const images_t& message, const image_t& left) {
  const image_t* zipped = FindImage(message, images_t::DEPTH_MM_ZIPPED);
  const image_t& depth =
      zipped != nullptr ? *zipped : RequireImage(message, images_t::DEPTH_MM, "no_depth_image");
  RequirePictureSize(depth.width, depth.height);
  RequireSameView(left, depth);
  if (zipped != nullptr) return InflatedDepth(depth);
  return FromRows(depth.data, {depth.width, depth.height}, depth.row_stride);
}

// Low byte first, as every processor that this runs on has it.
image_t FromDepth(const cv::Mat& depth_mm, Timestamp time) {
  const cv::Mat packed = depth_mm.isContinuous() ? depth_mm : depth_mm.clone();
  image_t message{};
  message.utime = time.microseconds;
  message.width = depth_mm.cols;
  message.height = depth_mm.rows;
  message.row_stride = depth_mm.cols * 2;
  message.pixelformat = image_t::PIXEL_FORMAT_INVALID;
  message.data = Deflate({packed.data, packed.total() * packed.elemSize()}, kDepthCompression);
  message.size = static_cast<std::int32_t>(message.data.size());
  return message;
}

}  // namespace

Decoded<StereoImage> Codec<StereoImage>::Decode(Bytes bytes) {
  const auto message = DecodeWire<images_t>(bytes);
  const image_t& left = RequireImage(message, images_t::LEFT, "no_left_image");
  StereoImage stereo;
  stereo.left = ToEncodedImage(left);
  stereo.left.time = ToTimestamp(message.utime);
  stereo.depth_mm = ToDepth(message, left);
  return {std::move(stereo), SequenceOf(left)};
}

std::vector<std::uint8_t> Codec<StereoImage>::Encode(const StereoImage& stereo,
                                                     std::int64_t sequence) {
  images_t message{};
  message.utime = stereo.left.time.microseconds;
  message.image_types = {images_t::LEFT, images_t::DEPTH_MM_ZIPPED};
  message.images = {FromEncodedImage(stereo.left, sequence),
                    FromDepth(stereo.depth_mm, stereo.left.time)};
  message.n_images = static_cast<std::int32_t>(message.images.size());
  return EncodeWire(message);
}

}  // namespace deixis::messages
