#include "common/capture/regular_file.h"

#include <array>
#include <fstream>

namespace deixis::capture {
namespace {

constexpr std::size_t kPiece = std::size_t{64} * 1024;

}  // namespace

std::optional<std::vector<std::uint8_t>> ReadRegularFile(const std::filesystem::path& file,
                                                         std::size_t most_bytes) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return std::nullopt;
  const auto stated = std::filesystem::file_size(file, ignored);
  if (ignored || stated > most_bytes) return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  // By pieces, since some files of /proc and those that still grow are longer than they say.
  std::vector<std::uint8_t> bytes;
  bytes.reserve(stated);
  std::array<char, kPiece> piece;
  while (stream.read(piece.data(), static_cast<std::streamsize>(kPiece)), stream.gcount() > 0) {
    bytes.insert(bytes.end(), piece.data(), piece.data() + stream.gcount());
    if (bytes.size() > most_bytes) return std::nullopt;
  }
  if (!stream.eof()) return std::nullopt;
  return bytes;
}

}  // namespace deixis::capture
