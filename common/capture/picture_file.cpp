#include "common/capture/picture_file.h"

#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>

namespace deixis::capture {

std::vector<std::uint8_t> ReadBytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
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
