#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>

namespace deixis::files {

/// A file cannot be written; the text names it and says why.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes a file whole or not at all: an older one stays as it is when that fails. Follows links;
/// throws FileError for folders, pipes and devices, which keep their place.
void WriteWhole(const std::filesystem::path& file, const std::string& bytes);

}  // namespace deixis::files
