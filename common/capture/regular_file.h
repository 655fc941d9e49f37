#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace deixis::capture {

/// The bytes of a file. Nothing when it is no regular file (a folder, pipe or device, which may
/// wait or never end), cannot be read, or has more than `most_bytes`.
std::optional<std::vector<std::uint8_t>> ReadRegularFile(const std::filesystem::path& file,
                                                         std::size_t most_bytes);

}  // namespace deixis::capture
