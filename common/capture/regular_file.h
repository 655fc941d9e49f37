#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace deixis::capture {

/// Why there are no bytes of a file.
enum class FileFault {
  kNone,
  kNoRegularFile,  ///< Not there, or a folder, pipe or device, which may wait or never end.
  kUnreadable,     ///< No rights, or the disk is damaged.
  kTooLarge,
};

struct FileContent {
  std::vector<std::uint8_t> bytes;  ///< Empty when there is a fault.
  FileFault fault = FileFault::kNone;
  std::string reason;  ///< Of kUnreadable: what the system says.
};

/// A regular file to its end, opened once. At most `most_bytes` of memory are taken for it.
FileContent ReadRegularFile(const std::filesystem::path& file, std::size_t most_bytes);

}  // namespace deixis::capture
