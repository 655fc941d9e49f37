#include "common/messages/image_parts.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "common/images/jpeg_check.h"
#include "common/images/picture_size.h"
#include "common/messages/wire.h"

namespace deixis::messages {
namespace {

using bot_core::image_t;
using bot_core::images_t;
using images::JpegFault;

constexpr const char* kCameraKey = "deixis.camera";
constexpr const char* kSequenceKey = "deixis.sequence";
constexpr std::int32_t kMostImages = 16;

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
void RequireHonestJpeg(const std::vector<std::uint8_t>& jpeg, cv::Size size) {
  const JpegFault fault = images::CheckJpeg(jpeg.data(), jpeg.size(), size.width, size.height);
  if (fault != JpegFault::kNone) throw Rejected(Reason(fault));
}

cv::Size SizeOf(const image_t& message) { return {message.width, message.height}; }

cv::Mat DecodePixels(const image_t& message) {
  const cv::Size size = SizeOf(message);
  const auto raw = [&](int type) {
    return RawPixels(message.data, size, type, message.row_stride);
  };
  switch (message.pixelformat) {
    case image_t::PIXEL_FORMAT_MJPEG:
      return DecodeJpeg(message.data, size);
    case image_t::PIXEL_FORMAT_BGR:
      return raw(CV_8UC3).clone();
    case image_t::PIXEL_FORMAT_RGB:
      return Converted(raw(CV_8UC3), cv::COLOR_RGB2BGR);
    case image_t::PIXEL_FORMAT_GRAY:
      return Converted(raw(CV_8UC1), cv::COLOR_GRAY2BGR);
    case image_t::PIXEL_FORMAT_YUYV:
      if (message.width % 2 != 0) throw Rejected("bad_image_size");
      return Converted(raw(CV_8UC2), cv::COLOR_YUV2BGR_YUYV);
    default:
      throw Rejected("bad_pixel_format");
  }
}

}  // namespace

void RequirePictureSize(std::int64_t width_px, std::int64_t height_px) {
  if (width_px <= 0 || height_px <= 0) throw Rejected("bad_image_size");
  if (!images::IsPictureSize(width_px, height_px)) throw Rejected("too_large");
}

cv::Mat DecodeJpeg(const std::vector<std::uint8_t>& jpeg, cv::Size size) {
  RequireHonestJpeg(jpeg, size);
  const cv::Mat bgr = cv::imdecode(jpeg, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  if (bgr.empty()) throw Rejected("bad_jpeg");
  return bgr;
}

cv::Mat RawPixels(const std::vector<std::uint8_t>& data, cv::Size size, int type,
                  std::int64_t stride) {
  const std::int64_t row = std::int64_t{size.width} * CV_ELEM_SIZE(type);
  const std::int64_t step = stride == 0 ? row : stride;
  const auto bytes = static_cast<std::int64_t>(data.size());
  if (step < row) throw Rejected("bad_row_stride");
  if (step * (size.height - 1) + row > bytes) throw Rejected("too_few_pixels");
  return {size, type, const_cast<std::uint8_t*>(data.data()), static_cast<std::size_t>(step)};
}

cv::Mat Converted(const cv::Mat& raw, int code) {
  cv::Mat bgr;
  cv::cvtColor(raw, bgr, code);
  return bgr;
}

images::Image ToImage(const image_t& message) {
  RequirePictureSize(message.width, message.height);
  return {ToTimestamp(message.utime), Metadata(message, kCameraKey), DecodePixels(message)};
}

image_t FromImage(const images::Image& image, std::int64_t sequence) {
  image_t message = FramedImage(image.time, image.camera, image.bgr.size(), sequence);
  message.pixelformat = image_t::PIXEL_FORMAT_BGR;
  const cv::Mat packed = image.bgr.isContinuous() ? image.bgr : image.bgr.clone();
  message.data.assign(packed.data, packed.data + packed.total() * packed.elemSize());
  message.size = static_cast<std::int32_t>(message.data.size());
  return message;
}

images::EncodedImage ToEncodedImage(image_t message) {
  RequirePictureSize(message.width, message.height);
  if (message.pixelformat != image_t::PIXEL_FORMAT_MJPEG) throw Rejected("bad_pixel_format");
  RequireHonestJpeg(message.data, SizeOf(message));
  return {ToTimestamp(message.utime), Metadata(message, kCameraKey), message.width, message.height,
          std::move(message.data)};
}

image_t FromEncodedImage(const images::EncodedImage& image, std::int64_t sequence) {
  image_t message =
      FramedImage(image.time, image.camera, {image.width_px, image.height_px}, sequence);
  message.pixelformat = image_t::PIXEL_FORMAT_MJPEG;
  message.data = image.jpeg;
  message.size = static_cast<std::int32_t>(message.data.size());
  return message;
}

image_t FramedImage(Timestamp time, const std::string& camera, cv::Size size,
                    std::int64_t sequence) {
  image_t message{};
  message.utime = time.microseconds;
  message.width = size.width;
  message.height = size.height;
  message.row_stride = size.width * 3;
  message.metadata = {Entry(kCameraKey, camera), Entry(kSequenceKey, std::to_string(sequence))};
  message.nmetadata = static_cast<std::int32_t>(message.metadata.size());
  return message;
}

std::int64_t SequenceOf(const image_t& message) {
  const std::string text = Metadata(message, kSequenceKey);
  const bool is_number = !text.empty() && text.size() < 18 &&
                         text.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? std::stoll(text) : -1;
}

const image_t* FindImage(const images_t& message, std::int16_t role) {
  RequireCount(message.n_images, kMostImages);
  for (std::size_t i = 0; i < message.images.size(); ++i) {
    if (message.image_types[i] == role) return &message.images[i];
  }
  return nullptr;
}

const image_t& RequireImage(const images_t& message, std::int16_t role, const char* reason) {
  const image_t* image = FindImage(message, role);
  if (image == nullptr) throw Rejected(reason);
  return *image;
}

}  // namespace deixis::messages
