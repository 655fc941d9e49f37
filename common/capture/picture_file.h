#pragma once
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace deixis::capture {

/// The file as it is; empty when it cannot be read.
std::vector<std::uint8_t> ReadBytes(const std::filesystem::path& file);

/// What a picture file shows; `flags` are cv::ImreadModes. Empty when it cannot be decoded,
/// whatever the reason: OpenCV throws at some, such as a header with an absurd size.
cv::Mat DecodePicture(const std::vector<std::uint8_t>& bytes, int flags);

}  // namespace deixis::capture
