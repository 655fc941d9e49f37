#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/messages/codec.h"

namespace deixis::messages {

/// The content of one whole zlib stream (RFC 1950), which must be of `expected_size` bytes; throws
/// Rejected otherwise: "zlib_too_short" (the stream or its content ends too early), "zlib_too_long"
/// (it holds more, as a zip bomb does), "zlib_trailing_bytes" (bytes behind the stream),
/// "zlib_damaged" (no zlib stream, or its checksum is wrong). Takes memory for `expected_size`
/// bytes (besides zlib's fixed 50 kB or so), and none when so few bytes cannot hold that much; so
/// bound `expected_size` by meaning first.
std::vector<std::uint8_t> InflateExactly(Bytes bytes, std::size_t expected_size);

/// One zlib stream of `bytes`. `level` is zlib's: 0 (stored) to 9 (smallest); 1 is fast.
std::vector<std::uint8_t> Deflate(Bytes bytes, int level);

}  // namespace deixis::messages
