#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>

namespace deixis::images {

/// What is wrong with a JPEG file (ITU T.81).
enum class JpegFault {
  kNone,
  kNoJpeg,        ///< No JPEG file, or its segments do not follow each other as they must.
  kOtherSize,     ///< Of another size than is said.
  kNotBaseline,   ///< Neither baseline nor sequential Huffman code. Progressive files are refused:
                  ///< each of their many scans costs a pass over the whole picture.
  kTooManyScans,  ///< More than it has components, which costs the same.
  kTruncated,     ///< No end, or fewer bytes than so many pixels take, however plain they are.
};

/// Goes over the file of `size` bytes before a decoder takes memory and time for it. Damage within
/// the coded pixels is not found: decoders get over it.
JpegFault CheckJpeg(const std::uint8_t* data, std::size_t size, int width_px, int height_px);

struct JpegSize {
  int width_px = 0;
  int height_px = 0;
};

/// The size that the file says it has; nothing where none is found. For pictures that come without
/// one: what else is wrong, CheckJpeg says.
std::optional<JpegSize> FindJpegSize(const std::uint8_t* data, std::size_t size);

}  // namespace deixis::images
