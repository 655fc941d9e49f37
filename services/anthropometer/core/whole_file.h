#pragma once
#include <filesystem>
#include <string>

namespace deixis::anthropometer {

/// Writes a file whole or not at all: an older one stays as it is when that fails. Throws
/// ConfigError naming the file.
void WriteWhole(const std::filesystem::path& file, const std::string& bytes);

}  // namespace deixis::anthropometer
