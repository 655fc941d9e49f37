#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace deixis::capture {

/// The bytes of a file. Nothing when it is no regular file (a folder, pipe or device, which may
/// wait or never end), cannot be read, or has more than `most_bytes`.
std::optional<std::string> ReadRegularFile(const std::filesystem::path& file,
                                           std::size_t most_bytes);

}  // namespace deixis::capture
