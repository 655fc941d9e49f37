#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace deixis::capture {

/// No picture's file is larger: that is more than all its pixels.
inline constexpr std::size_t kLargestPictureFile = std::size_t{256} * 1024 * 1024;

/// The file as it is; empty when it cannot be read, is no regular file (a folder, pipe or device)
/// or larger than any picture's.
std::vector<std::uint8_t> ReadBytes(const std::filesystem::path& file);

/// What a picture file shows; `flags` are cv::ImreadModes. Empty when it cannot be decoded,
/// whatever the reason (OpenCV throws at some, such as a header with an absurd size), or is a JPEG
/// file that was cut.
cv::Mat DecodePicture(const std::vector<std::uint8_t>& bytes, int flags);

}  // namespace deixis::capture
