#include "common/capture/picture_file.h"

#include <opencv2/imgcodecs.hpp>

#include "common/capture/regular_file.h"
#include "common/images/jpeg_check.h"

namespace deixis::capture {
namespace {

/// Decoders make up what a cut file lacks, in grey.
bool IsCutJpeg(const std::vector<std::uint8_t>& bytes) {
  const auto size = images::FindJpegSize(bytes.data(), bytes.size());
  return size && images::CheckJpeg(bytes.data(), bytes.size(), size->width_px, size->height_px) ==
                     images::JpegFault::kTruncated;
}

}  // namespace

std::vector<std::uint8_t> ReadBytes(const std::filesystem::path& file) {
  return ReadRegularFile(file, kLargestPictureFile).bytes;
}

cv::Mat DecodePicture(const std::vector<std::uint8_t>& bytes, int flags) {
  if (bytes.empty() || IsCutJpeg(bytes)) return {};
  try {
    return cv::imdecode(bytes, flags);
  } catch (const cv::Exception&) {
    return {};
  }
}

}  // namespace deixis::capture
