#include "common/files/whole_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace deixis::files {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void Refuse(const fs::path& file, const std::string& why) {
  throw FileError(file.string() + ": cannot be written: " + why);
}

}  // namespace

void WriteWhole(const fs::path& file, const std::string& bytes) {
  std::error_code error;
  if (fs::is_directory(file, error)) Refuse(file, "it is a folder");
  // A name would take the place of a device, and of a link instead of what it leads to.
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) {
    Refuse(file, "it is no regular file");
  }
  const fs::path final = fs::weakly_canonical(file, error);
  if (error) Refuse(file, error.message());
  const fs::path unfinished = final.string() + "." + std::to_string(getpid()) + ".part";
  std::ofstream out(unfinished, std::ios::binary);
  if (!out) Refuse(file, std::strerror(errno));
  out << bytes;
  out.close();
  if (out) fs::rename(unfinished, final, error);
  if (!out || error) {
    const std::string why = error ? error.message() : "no room";
    fs::remove(unfinished, error);
    Refuse(file, why);
  }
}

}  // namespace deixis::files
