#include "common/capture/picture_encoder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "common/images/jpeg_check.h"

namespace deixis::capture {
namespace {

constexpr std::size_t kHeaderBytes = 4096;

cv::Size PublishedSize(cv::Size size, int max_width_px) {
  if (max_width_px == 0 || size.width <= max_width_px) return size;
  const double scale = static_cast<double>(max_width_px) / size.width;
  return {max_width_px, std::max(1, static_cast<int>(std::lround(scale * size.height)))};
}

// Files with EXIF may ask for the picture to be turned, which not every receiver does.
bool HasExif(const std::vector<std::uint8_t>& jpeg) {
  static constexpr std::array<std::uint8_t, 5> kExif{'E', 'x', 'i', 'f', 0};
  const auto end = jpeg.begin() + static_cast<std::ptrdiff_t>(std::min(jpeg.size(), kHeaderBytes));
  return std::search(jpeg.begin(), end, kExif.begin(), kExif.end()) != end;
}

// Receivers refuse progressive files, and those that are damaged.
bool IsReceived(const std::vector<std::uint8_t>& jpeg, cv::Size size) {
  return images::CheckJpeg(jpeg.data(), jpeg.size(), size.width, size.height) ==
         images::JpegFault::kNone;
}

cv::Mat Resized(const cv::Mat& bgr, cv::Size size) {
  if (bgr.size() == size) return bgr;
  cv::Mat smaller;
  cv::resize(bgr, smaller, size, 0.0, 0.0, cv::INTER_AREA);
  return smaller;
}

}  // namespace

void EncodingConfig::Check(config::Faults& faults) const {
  faults.Require(jpeg_quality >= 1 && jpeg_quality <= 100, "image.jpeg_quality",
                 "must lie in 1..100");
  faults.Require(max_width_px >= 0, "image.max_width_px", "must not be negative");
}

images::EncodedImage Encode(const Picture& picture, Timestamp time, const std::string& camera,
                            const EncodingConfig& config) {
  const cv::Size size = PublishedSize(picture.bgr.size(), config.max_width_px);
  images::EncodedImage image;
  image.time = time;
  image.camera = camera;
  image.width_px = size.width;
  image.height_px = size.height;
  const bool suits =
      size == picture.bgr.size() && !HasExif(picture.jpeg) && IsReceived(picture.jpeg, size);
  if (!picture.jpeg.empty() && suits) {
    image.jpeg = picture.jpeg;
  } else {
    cv::imencode(".jpg", Resized(picture.bgr, size), image.jpeg,
                 {cv::IMWRITE_JPEG_QUALITY, config.jpeg_quality});
  }
  return image;
}

}  // namespace deixis::capture
