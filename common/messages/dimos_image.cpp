#include <array>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <string_view>

#include "common/images/jpeg_check.h"
#include "common/messages/dimos_parts.h"
#include "common/messages/image_parts.h"
#include "common/messages/wire.h"

namespace deixis::messages {
namespace {

constexpr int kAsItIs = -1;  // No colour conversion.
constexpr std::int32_t kNanosecondsPerSecond = 1'000'000'000;

// Names of ROS (sensor_msgs/image_encodings.h); types and conversions of OpenCV.
struct Encoding {
  std::string_view name;
  int type;
  int conversion;
};
constexpr std::array<Encoding, 11> kEncodings{{
    {"bgr8", CV_8UC3, kAsItIs},
    {"8UC3", CV_8UC3, kAsItIs},
    {"rgb8", CV_8UC3, cv::COLOR_RGB2BGR},
    {"bgra8", CV_8UC4, cv::COLOR_BGRA2BGR},
    {"rgba8", CV_8UC4, cv::COLOR_RGBA2BGR},
    {"mono8", CV_8UC1, cv::COLOR_GRAY2BGR},
    {"8UC1", CV_8UC1, cv::COLOR_GRAY2BGR},
    {"yuv422", CV_8UC2, cv::COLOR_YUV2BGR_UYVY},
    {"uyvy", CV_8UC2, cv::COLOR_YUV2BGR_UYVY},
    {"yuv422_yuy2", CV_8UC2, cv::COLOR_YUV2BGR_YUYV},
    {"yuyv", CV_8UC2, cv::COLOR_YUV2BGR_YUYV},
}};

const Encoding& RequireEncoding(const std::string& name) {
  for (const Encoding& encoding : kEncodings) {
    if (encoding.name == name) return encoding;
  }
  throw Rejected("bad_pixel_format");
}

bool IsJpeg(const std::string& encoding) { return encoding == "jpeg" || encoding == "jpg"; }

// "jpeg" alone, or as ROS has it: "rgb8; jpeg compressed bgr8".
bool SaysJpeg(const std::string& format) {
  return format.find("jpeg") != std::string::npos || format.find("jpg") != std::string::npos;
}

cv::Mat DecodePixels(const sensor_msgs::Image& message) {
  const cv::Size size(message.width, message.height);
  if (IsJpeg(message.encoding)) return DecodeJpeg(message.data, size);
  const auto& [name, type, conversion] = RequireEncoding(message.encoding);
  if (type == CV_8UC2 && message.width % 2 != 0) throw Rejected("bad_image_size");
  const cv::Mat raw = RawPixels(message.data, size, type, message.step);
  return conversion == kAsItIs ? raw.clone() : Converted(raw, conversion);
}

}  // namespace

Timestamp ToTimestamp(const std_msgs::Time& stamp) {
  const bool is_time = stamp.sec >= 0 && stamp.nsec >= 0 && stamp.nsec < kNanosecondsPerSecond;
  if (!is_time) throw Rejected("out_of_range");
  return {std::int64_t{stamp.sec} * 1'000'000 + stamp.nsec / 1000};
}

std_msgs::Header ToHeader(Timestamp time, const std::string& camera) {
  if (time.microseconds / 1'000'000 > std::numeric_limits<std::int32_t>::max()) {
    throw std::logic_error("a time to be published is later than std_msgs.Time can say");
  }
  std_msgs::Header header{};
  header.stamp.sec = static_cast<std::int32_t>(time.microseconds / 1'000'000);
  header.stamp.nsec = static_cast<std::int32_t>(time.microseconds % 1'000'000) * 1000;
  header.frame_id = camera;
  return header;
}

images::Image ToImage(const sensor_msgs::Image& message) {
  RequirePictureSize(message.width, message.height);
  return {ToTimestamp(message.header.stamp), Text(message.header.frame_id), DecodePixels(message)};
}

images::Image ToImage(const sensor_msgs::CompressedImage& message) {
  if (!SaysJpeg(message.format)) throw Rejected("bad_pixel_format");
  const auto size = images::FindJpegSize(message.data.data(), message.data.size());
  if (!size) throw Rejected("bad_jpeg");
  RequirePictureSize(size->width_px, size->height_px);
  return {ToTimestamp(message.header.stamp), Text(message.header.frame_id),
          DecodeJpeg(message.data, {size->width_px, size->height_px})};
}

}  // namespace deixis::messages
