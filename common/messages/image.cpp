#include "common/messages/image.h"

#include <bot_core/images_t.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "common/images/jpeg_check.h"
#include "common/messages/wire.h"

namespace deixis::messages {
namespace {

using bot_core::image_t;
using bot_core::images_t;
using images::EncodedImage;
using images::Image;
using images::JpegFault;

constexpr const char* kCameraKey = "deixis.camera";
constexpr const char* kSequenceKey = "deixis.sequence";

std::string Metadata(const image_t& message, const std::string& key) {
  for (const auto& entry : message.metadata) {
    if (entry.key == key) return Text({entry.value.begin(), entry.value.end()});
  }
  return "";
}

bot_core::image_metadata_t Entry(const std::string& key, const std::string& value) {
  bot_core::image_metadata_t entry{};
  entry.key = key;
  entry.value.assign(value.begin(), value.end());
  entry.n = static_cast<std::int32_t>(entry.value.size());
  return entry;
}

std::int64_t Sequence(const image_t& message) {
  const std::string text = Metadata(message, kSequenceKey);
  const bool is_number = !text.empty() && text.size() < 18 &&
                         text.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? std::stoll(text) : -1;
}

void RequireSize(const image_t& message) {
  const std::int64_t pixels = std::int64_t{message.width} * message.height;
  if (message.width <= 0 || message.height <= 0) throw Rejected("bad_image_size");
  if (pixels > kMostPixels) throw Rejected("too_large");
}

const char* Reason(JpegFault fault) {
  switch (fault) {
    case JpegFault::kOtherSize:
      return "jpeg_size";
    case JpegFault::kNotBaseline:
      return "jpeg_not_baseline";
    case JpegFault::kTooManyScans:
      return "jpeg_too_many_scans";
    case JpegFault::kTruncated:
      return "jpeg_truncated";
    default:
      return "bad_jpeg";
  }
}

// A picture that lies is refused before memory and time are taken for it.
void RequireHonestJpeg(const image_t& message) {
  const JpegFault fault =
      images::CheckJpeg(message.data.data(), message.data.size(), message.width, message.height);
  if (fault != JpegFault::kNone) throw Rejected(Reason(fault));
}

cv::Mat DecodeJpeg(const image_t& message) {
  RequireHonestJpeg(message);
  const cv::Mat bgr = cv::imdecode(message.data, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  if (bgr.empty()) throw Rejected("bad_jpeg");
  return bgr;
}

// The raw pixels as they lie in the message: `type` is OpenCV's, 8 bits per channel.
cv::Mat RawPixels(const image_t& message, int type) {
  const std::int64_t row = std::int64_t{message.width} * CV_ELEM_SIZE(type);
  const std::int64_t stride = message.row_stride == 0 ? row : message.row_stride;
  if (stride < row) throw Rejected("bad_row_stride");
  if (stride * (message.height - 1) + row > message.size) throw Rejected("too_few_pixels");
  return {message.height, message.width, type, const_cast<std::uint8_t*>(message.data.data()),
          static_cast<std::size_t>(stride)};
}

cv::Mat Converted(const cv::Mat& raw, int code) {
  cv::Mat bgr;
  cv::cvtColor(raw, bgr, code);
  return bgr;
}

cv::Mat DecodePixels(const image_t& message) {
  switch (message.pixelformat) {
    case image_t::PIXEL_FORMAT_MJPEG:
      return DecodeJpeg(message);
    case image_t::PIXEL_FORMAT_BGR:
      return RawPixels(message, CV_8UC3).clone();
    case image_t::PIXEL_FORMAT_RGB:
      return Converted(RawPixels(message, CV_8UC3), cv::COLOR_RGB2BGR);
    case image_t::PIXEL_FORMAT_GRAY:
      return Converted(RawPixels(message, CV_8UC1), cv::COLOR_GRAY2BGR);
    case image_t::PIXEL_FORMAT_YUYV:
      if (message.width % 2 != 0) throw Rejected("bad_image_size");
      return Converted(RawPixels(message, CV_8UC2), cv::COLOR_YUV2BGR_YUYV);
    default:
      throw Rejected("bad_pixel_format");
  }
}

const image_t& LeftOf(const images_t& message) {
  if (message.n_images < 0 || message.n_images > 16) throw Rejected("too_many");
  for (std::size_t i = 0; i < message.images.size(); ++i) {
    if (message.image_types[i] == images_t::LEFT) return message.images[i];
  }
  throw Rejected("no_left_image");
}

Decoded<Image> ToImage(const image_t& message) {
  RequireSize(message);
  return {{ToTimestamp(message.utime), Metadata(message, kCameraKey), DecodePixels(message)},
          Sequence(message)};
}

image_t Framed(Timestamp time, const std::string& camera, cv::Size size, std::int64_t sequence) {
  image_t message{};
  message.utime = time.microseconds;
  message.width = size.width;
  message.height = size.height;
  message.row_stride = size.width * 3;
  message.metadata = {Entry(kCameraKey, camera), Entry(kSequenceKey, std::to_string(sequence))};
  message.nmetadata = static_cast<std::int32_t>(message.metadata.size());
  return message;
}

}  // namespace

Decoded<EncodedImage> Codec<EncodedImage>::Decode(Bytes bytes) {
  auto message = DecodeWire<image_t>(bytes);
  RequireSize(message);
  if (message.pixelformat != image_t::PIXEL_FORMAT_MJPEG) throw Rejected("bad_pixel_format");
  RequireHonestJpeg(message);
  const std::int64_t sequence = Sequence(message);
  return {{ToTimestamp(message.utime), Metadata(message, kCameraKey), message.width, message.height,
           std::move(message.data)},
          sequence};
}

std::vector<std::uint8_t> Codec<EncodedImage>::Encode(const EncodedImage& image,
                                                      std::int64_t sequence) {
  image_t message = Framed(image.time, image.camera, {image.width_px, image.height_px}, sequence);
  message.pixelformat = image_t::PIXEL_FORMAT_MJPEG;
  message.data = image.jpeg;
  message.size = static_cast<std::int32_t>(message.data.size());
  return EncodeWire(message);
}

Decoded<Image> Codec<Image>::Decode(Bytes bytes) {
  if (Fingerprint(bytes) == images_t::getHash()) {
    return ToImage(LeftOf(DecodeWire<images_t>(bytes)));
  }
  return ToImage(DecodeWire<image_t>(bytes));
}

std::vector<std::uint8_t> Codec<Image>::Encode(const Image& image, std::int64_t sequence) {
  image_t message = Framed(image.time, image.camera, image.bgr.size(), sequence);
  message.pixelformat = image_t::PIXEL_FORMAT_BGR;
  const cv::Mat packed = image.bgr.isContinuous() ? image.bgr : image.bgr.clone();
  message.data.assign(packed.data, packed.data + packed.total() * packed.elemSize());
  message.size = static_cast<std::int32_t>(message.data.size());
  return EncodeWire(message);
}

}  // namespace deixis::messages
