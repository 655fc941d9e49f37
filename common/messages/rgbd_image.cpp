#include "common/messages/rgbd_image.h"

#include <cmath>
#include <kinect/frame_msg_t.hpp>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "common/messages/image_parts.h"
#include "common/messages/inflate.h"
#include "common/messages/wire.h"

namespace deixis::messages {
namespace {

using images::RgbdImage;
using kinect::depth_msg_t;
using kinect::frame_msg_t;
using kinect::image_msg_t;

constexpr const char* kCamera = "kinect";
constexpr int kDepthCompression = 1;
constexpr int kNoReading = 2047;  // Of 11 bits.

cv::Mat ToColour(const image_msg_t& message) {
  const cv::Size size(message.width, message.height);
  const auto converted = [&](int type, int code) {
    return Converted(RawPixels(message.image_data, size, type, 0), code);
  };
  switch (message.image_data_format) {
    case image_msg_t::VIDEO_RGB:
      return converted(CV_8UC3, cv::COLOR_RGB2BGR);
    case image_msg_t::VIDEO_RGB_JPEG:
      return DecodeJpeg(message.image_data, size);
    case image_msg_t::VIDEO_BAYER:  // Green red / blue green, which OpenCV names by its second row.
      if (size.width < 3 || size.height < 3) throw Rejected("bad_image_size");
      return converted(CV_8UC1, cv::COLOR_BayerGB2BGR);
    case image_msg_t::VIDEO_IR_8BIT:
      return converted(CV_8UC1, cv::COLOR_GRAY2BGR);
    case image_msg_t::VIDEO_YUV_RAW:
      if (message.width % 2 != 0) throw Rejected("bad_image_size");
      return converted(CV_8UC2, cv::COLOR_YUV2BGR_UYVY);
    case image_msg_t::VIDEO_NONE:
      throw Rejected("no_colour_image");
    default:
      throw Rejected("bad_pixel_format");
  }
}

// The sensor's 11 bits as millimetres: S. Magnenat's fit, z = 0.1236 m * tan(raw / 2842.5 +
// 1.1863), as the OpenKinect project publishes it.
std::uint16_t MillimetresOf11Bits(std::uint16_t raw) {
  if (raw >= kNoReading) return 0;
  const double z_mm = 123.6 * std::tan(raw / 2842.5 + 1.1863);
  const bool is_depth = z_mm > 0.0 && z_mm <= std::numeric_limits<std::uint16_t>::max();
  return is_depth ? static_cast<std::uint16_t>(std::lround(z_mm)) : std::uint16_t{0};
}

cv::Mat From11Bits(cv::Mat raw) {
  std::vector<std::uint16_t> table(kNoReading + 1);
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = MillimetresOf11Bits(static_cast<std::uint16_t>(i));
  }
  for (auto value = raw.begin<std::uint16_t>(); value != raw.end<std::uint16_t>(); ++value) {
    *value = *value < table.size() ? table[*value] : std::uint16_t{0};
  }
  return raw;
}

cv::Mat DepthRows(const depth_msg_t& message) {
  const cv::Size size(message.width, message.height);
  const std::vector<std::uint8_t>& data = message.depth_data;
  if (message.compression == depth_msg_t::COMPRESSION_NONE) {
    return RawPixels(data, size, CV_16UC1, 0).clone();
  }
  if (message.compression != depth_msg_t::COMPRESSION_ZLIB) throw Rejected("bad_pixel_format");
  const auto bytes = static_cast<std::size_t>(size.area()) * 2;
  return RawPixels(InflateExactly({data.data(), data.size()}, bytes), size, CV_16UC1, 0).clone();
}

cv::Mat ToDepth(const depth_msg_t& message) {
  switch (message.depth_data_format) {
    case depth_msg_t::DEPTH_MM:
    case depth_msg_t::DEPTH_REGISTERED:
      return DepthRows(message);
    case depth_msg_t::DEPTH_11BIT:
      return From11Bits(DepthRows(message));
    case depth_msg_t::DEPTH_NONE:
      throw Rejected("no_depth_image");
    default:
      throw Rejected("bad_pixel_format");
  }
}

std::int64_t TimeOr(std::int64_t own, std::int64_t of_frame) { return own > 0 ? own : of_frame; }

std::int16_t Size16(int size_px) {
  if (size_px > std::numeric_limits<std::int16_t>::max()) {
    throw std::logic_error("a picture is larger than kinect.frame_msg_t can say");
  }
  return static_cast<std::int16_t>(size_px);
}

image_msg_t FromColour(const images::Image& colour) {
  image_msg_t message{};
  message.timestamp = colour.time.microseconds;
  message.width = Size16(colour.bgr.cols);
  message.height = Size16(colour.bgr.rows);
  message.image_data_format = image_msg_t::VIDEO_RGB;
  const cv::Mat rgb = Converted(colour.bgr, cv::COLOR_BGR2RGB);
  message.image_data.assign(rgb.data, rgb.data + rgb.total() * rgb.elemSize());
  message.image_data_nbytes = static_cast<std::int32_t>(message.image_data.size());
  return message;
}

depth_msg_t FromDepth(const RgbdImage& image) {
  const cv::Mat& depth_mm = image.depth.depth_mm;
  const cv::Mat packed = depth_mm.isContinuous() ? depth_mm : depth_mm.clone();
  const Bytes rows{packed.data, packed.total() * packed.elemSize()};
  depth_msg_t message{};
  message.timestamp = image.depth.time.microseconds;
  message.width = Size16(packed.cols);
  message.height = Size16(packed.rows);
  message.depth_data_format =
      image.is_registered ? depth_msg_t::DEPTH_REGISTERED : depth_msg_t::DEPTH_MM;
  message.compression = depth_msg_t::COMPRESSION_ZLIB;
  message.uncompressed_size = static_cast<std::int32_t>(rows.size);
  message.depth_data = Deflate(rows, kDepthCompression);
  message.depth_data_nbytes = static_cast<std::int32_t>(message.depth_data.size());
  return message;
}

}  // namespace

Decoded<RgbdImage> Codec<RgbdImage>::Decode(Bytes bytes) {
  const auto message = DecodeWire<frame_msg_t>(bytes);
  RequirePictureSize(message.image.width, message.image.height);
  RequirePictureSize(message.depth.width, message.depth.height);
  RgbdImage image;
  image.colour = {ToTimestamp(TimeOr(message.image.timestamp, message.timestamp)), kCamera,
                  ToColour(message.image)};
  image.depth = {ToTimestamp(TimeOr(message.depth.timestamp, message.timestamp)), kCamera,
                 ToDepth(message.depth)};
  image.is_registered = message.depth.depth_data_format == depth_msg_t::DEPTH_REGISTERED;
  return {std::move(image), -1};
}

std::vector<std::uint8_t> Codec<RgbdImage>::Encode(const RgbdImage& image, std::int64_t) {
  frame_msg_t message{};
  message.timestamp = image.colour.time.microseconds;
  message.image = FromColour(image.colour);
  message.depth = FromDepth(image);
  return EncodeWire(message);
}

}  // namespace deixis::messages
