#include "common/messages/depth_image.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "common/messages/dimos_parts.h"
#include "common/messages/image_parts.h"
#include "common/messages/wire.h"

namespace deixis::messages {
namespace {

using images::DepthImage;

constexpr float kMillimetres = 1000.0F;  // of a metre
constexpr float kTooFar_mm = 65535.5F;

// Every value's bytes in reverse order, where the sender's order is not this machine's.
template <typename Value>
void ReverseBytes(cv::Mat& values) {
  for (auto value = values.begin<Value>(); value != values.end<Value>(); ++value) {
    auto* const bytes = reinterpret_cast<std::uint8_t*>(&*value);
    std::reverse(bytes, bytes + sizeof(Value));
  }
}

// A copy, byte by byte, since the rows in a message need not lie where a Value may.
template <typename Value>
cv::Mat Rows(const sensor_msgs::Image& message) {
  const cv::Size size(message.width, message.height);
  const int bytes = CV_8UC(static_cast<int>(sizeof(Value)));
  const cv::Mat sent = RawPixels(message.data, size, bytes, message.step);
  cv::Mat rows(size, cv::DataType<Value>::type);
  cv::Mat bytes_of_rows(size, bytes, rows.data);
  sent.copyTo(bytes_of_rows);
  if (message.is_bigendian != 0) ReverseBytes<Value>(rows);
  return rows;
}

std::uint16_t MillimetresOf(float z_m) {
  const float z_mm = z_m * kMillimetres;
  const bool is_depth = z_mm > 0.0F && z_mm < kTooFar_mm;  // No NaN is.
  return is_depth ? static_cast<std::uint16_t>(std::lround(z_mm)) : std::uint16_t{0};
}

cv::Mat FromMetres(const cv::Mat& depth_m) {
  cv::Mat depth_mm(depth_m.size(), CV_16UC1);
  std::transform(depth_m.begin<float>(), depth_m.end<float>(), depth_mm.begin<std::uint16_t>(),
                 MillimetresOf);
  return depth_mm;
}

cv::Mat ToMillimetres(const sensor_msgs::Image& message) {
  if (message.encoding == "16UC1" || message.encoding == "mono16") {
    return Rows<std::uint16_t>(message);
  }
  if (message.encoding == "32FC1") return FromMetres(Rows<float>(message));
  throw Rejected("bad_pixel_format");
}

sensor_msgs::Image FromDepthImage(const DepthImage& depth) {
  const cv::Mat packed = depth.depth_mm.isContinuous() ? depth.depth_mm : depth.depth_mm.clone();
  sensor_msgs::Image message{};
  message.header = ToHeader(depth.time, depth.camera);
  message.height = packed.rows;
  message.width = packed.cols;
  message.encoding = "16UC1";
  message.step = packed.cols * static_cast<std::int32_t>(sizeof(std::uint16_t));
  message.data.assign(packed.data, packed.data + packed.total() * packed.elemSize());
  message.data_length = static_cast<std::int32_t>(message.data.size());
  return message;
}

}  // namespace

DepthImage ToDepthImage(const sensor_msgs::Image& message) {
  RequirePictureSize(message.width, message.height);
  return {ToTimestamp(message.header.stamp), Text(message.header.frame_id), ToMillimetres(message)};
}

Decoded<DepthImage> Codec<DepthImage>::Decode(Bytes bytes) {
  return {ToDepthImage(DecodeWire<sensor_msgs::Image>(bytes)), -1};
}

std::vector<std::uint8_t> Codec<DepthImage>::Encode(const DepthImage& depth, std::int64_t) {
  return EncodeWire(FromDepthImage(depth));
}

}  // namespace deixis::messages
