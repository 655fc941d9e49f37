#include "common/messages/inflate.h"

#include <zlib.h>

#include <limits>
#include <new>
#include <stdexcept>

namespace deixis::messages {
namespace {

// RFC 1951: the densest code gives 258 bytes for two bits.
constexpr std::size_t kLargestRatio = 1032;
constexpr std::size_t kMostBytes = std::numeric_limits<uInt>::max();

// zlib's state, freed whatever happens.
class Inflater {
 public:
  explicit Inflater(Bytes bytes) {
    stream_.next_in = const_cast<Bytef*>(bytes.data);
    stream_.avail_in = static_cast<uInt>(bytes.size);
    if (inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  // Fills `size` bytes at `data`; true when the stream ends there, or before.
  bool FillsToEnd(std::uint8_t* data, std::size_t size) {
    stream_.next_out = data;
    stream_.avail_out = static_cast<uInt>(size);
    const int result = inflate(&stream_, Z_FINISH);
    if (result == Z_MEM_ERROR) throw std::bad_alloc();
    if (result != Z_STREAM_END && result != Z_BUF_ERROR) throw Rejected("zlib_damaged");
    return result == Z_STREAM_END;
  }

  std::size_t room_left() const { return stream_.avail_out; }
  std::size_t bytes_left() const { return stream_.avail_in; }

 private:
  z_stream stream_{};
};

}  // namespace

std::vector<std::uint8_t> InflateExactly(Bytes bytes, std::size_t expected_size) {
  if (bytes.size > kMostBytes || expected_size > kMostBytes) throw Rejected("too_large");
  if (bytes.size == 0 || expected_size / kLargestRatio > bytes.size) {
    throw Rejected("zlib_too_short");
  }
  Inflater inflater(bytes);
  std::vector<std::uint8_t> content(expected_size);
  std::uint8_t beyond = 0;  // zlib wants a place even for nothing
  const bool ends = inflater.FillsToEnd(content.empty() ? &beyond : content.data(), expected_size);
  if (inflater.room_left() > 0) throw Rejected("zlib_too_short");
  if (!ends) {
    inflater.FillsToEnd(&beyond, 1);
    throw Rejected(inflater.room_left() == 0 ? "zlib_too_long" : "zlib_too_short");
  }
  if (inflater.bytes_left() > 0) throw Rejected("zlib_trailing_bytes");
  return content;
}

std::vector<std::uint8_t> Deflate(Bytes bytes, int level) {
  if (level < 0 || level > 9) throw std::logic_error("zlib has levels 0 to 9");
  uLongf size = compressBound(static_cast<uLong>(bytes.size));
  std::vector<std::uint8_t> stream(size);
  if (compress2(stream.data(), &size, bytes.data, static_cast<uLong>(bytes.size), level) != Z_OK) {
    throw std::bad_alloc();
  }
  stream.resize(size);
  return stream;
}

}  // namespace deixis::messages
