#include "common/capture/regular_file.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace deixis::capture {
namespace {

constexpr std::size_t kPiece = std::size_t{64} * 1024;

FileContent Unreadable() { return {{}, FileFault::kUnreadable, std::strerror(errno)}; }

}  // namespace

FileContent ReadRegularFile(const std::filesystem::path& file, std::size_t most_bytes) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return {{}, FileFault::kNoRegularFile, ""};
  const auto stated = std::filesystem::file_size(file, error);
  if (!error && stated > most_bytes) return {{}, FileFault::kTooLarge, ""};
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  // By pieces, since some files of /proc and those that still grow are longer than they say.
  FileContent content;
  if (!error) content.bytes.reserve(stated);
  std::array<char, kPiece> piece;
  while (stream.read(piece.data(), static_cast<std::streamsize>(kPiece)), stream.gcount() > 0) {
    content.bytes.insert(content.bytes.end(), piece.data(), piece.data() + stream.gcount());
    if (content.bytes.size() > most_bytes) return {{}, FileFault::kTooLarge, ""};
  }
  return stream.eof() ? content : Unreadable();
}

}  // namespace deixis::capture
