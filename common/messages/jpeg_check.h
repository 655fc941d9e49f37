#pragma once
#include "common/messages/codec.h"

namespace deixis::messages {

/// Goes over a JPEG file (ITU T.81) before a decoder takes memory and time for it. Throws Rejected:
/// - "bad_jpeg": no JPEG file, or its segments do not follow each other as they must;
/// - "jpeg_size": its size is not `width_px` x `height_px`;
/// - "jpeg_not_baseline": neither baseline nor sequential Huffman code; progressive files are
///   refused, as each of their many scans costs a pass over the whole picture;
/// - "jpeg_too_many_scans": more scans than it has components, which costs the same;
/// - "jpeg_truncated": no end, or fewer bytes than so many pixels take however plain they are.
/// Damage within the coded pixels is not found: the decoder gets over it.
void RequireHonestJpeg(Bytes jpeg, int width_px, int height_px);

}  // namespace deixis::messages
