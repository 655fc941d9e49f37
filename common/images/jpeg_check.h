#pragma once
#include <cstddef>
#include <cstdint>

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

}  // namespace deixis::images
