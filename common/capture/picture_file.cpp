#include "common/capture/picture_file.h"

#include <opencv2/imgcodecs.hpp>

#include "common/capture/regular_file.h"

namespace deixis::capture {

std::vector<std::uint8_t> ReadBytes(const std::filesystem::path& file) {
  return ReadRegularFile(file, kLargestPictureFile).value_or(std::vector<std::uint8_t>());
}

cv::Mat DecodePicture(const std::vector<std::uint8_t>& bytes, int flags) {
  if (bytes.empty()) return {};
  try {
    return cv::imdecode(bytes, flags);
  } catch (const cv::Exception&) {
    return {};
  }
}

}  // namespace deixis::capture
