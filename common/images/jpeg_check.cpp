#include "common/images/jpeg_check.h"

#include <cstring>

namespace deixis::images {
namespace {

// Table B.1.
constexpr int kStartOfImage = 0xD8;
constexpr int kEndOfImage = 0xD9;
constexpr int kStartOfScan = 0xDA;
constexpr int kBaseline = 0xC0;
constexpr int kSequential = 0xC1;
// An 8 x 8 block takes a code for its mean and one for its end, one bit each at least.
constexpr std::int64_t kMostPixelsPerByte = 256;

// Ends the walk, within this file only.
struct Stop {
  JpegFault fault;
};

struct Segment {
  const std::uint8_t* data;
  std::size_t size;
};

bool IsFrame(int marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

bool IsWithinScan(int second) { return second == 0 || (second >= 0xD0 && second <= 0xD7); }

class File {
 public:
  File(const std::uint8_t* data, std::size_t size) : at_(data), left_(size) {}

  // The next marker; it stands where this is.
  int Marker() {
    if (Byte() != 0xFF) throw Stop{JpegFault::kNoJpeg};
    int marker = 0xFF;
    while (marker == 0xFF) marker = Byte();
    return marker;
  }

  // What stands behind a marker, without its length.
  Segment NextSegment() {
    const int size = Byte() << 8;
    const int whole = size | Byte();
    if (whole < 2) throw Stop{JpegFault::kNoJpeg};
    const auto content = static_cast<std::size_t>(whole - 2);
    if (content > left_) throw Stop{JpegFault::kTruncated};
    const Segment segment{at_, content};
    Skip(content);
    return segment;
  }

  // To the marker that ends the coded pixels.
  void SkipScan() {
    for (;;) {
      const auto* marker =
          left_ == 0 ? nullptr : static_cast<const std::uint8_t*>(std::memchr(at_, 0xFF, left_));
      if (marker == nullptr) throw Stop{JpegFault::kTruncated};
      Skip(static_cast<std::size_t>(marker - at_));
      if (left_ < 2) throw Stop{JpegFault::kTruncated};
      if (!IsWithinScan(at_[1])) return;
      Skip(2);
    }
  }

 private:
  int Byte() {
    if (left_ == 0) throw Stop{JpegFault::kTruncated};
    const int byte = *at_;
    Skip(1);
    return byte;
  }

  void Skip(std::size_t size) {
    at_ += size;
    left_ -= size;
  }

  const std::uint8_t* at_;
  std::size_t left_;
};

JpegSize SizeOf(Segment frame) {
  if (frame.size < 6) throw Stop{JpegFault::kNoJpeg};
  return {frame.data[3] << 8 | frame.data[4], frame.data[1] << 8 | frame.data[2]};
}

// The frame's size is that of the message; returns its number of components.
int CheckFrame(int marker, Segment frame, int width_px, int height_px) {
  if (marker != kBaseline && marker != kSequential) throw Stop{JpegFault::kNotBaseline};
  const JpegSize size = SizeOf(frame);
  if (size.width_px != width_px || size.height_px != height_px) throw Stop{JpegFault::kOtherSize};
  return frame.data[5];
}

JpegSize FirstFrame(File file) {
  if (file.Marker() != kStartOfImage) throw Stop{JpegFault::kNoJpeg};
  for (int marker = file.Marker(); marker != kEndOfImage; marker = file.Marker()) {
    const Segment segment = file.NextSegment();
    if (IsFrame(marker)) return SizeOf(segment);
    if (marker == kStartOfScan) file.SkipScan();
  }
  throw Stop{JpegFault::kNoJpeg};
}

// The file must be able to hold so many pixels.
void RequireRoom(std::size_t size, int width_px, int height_px) {
  const std::int64_t pixels = std::int64_t{width_px} * height_px;
  if (pixels / kMostPixelsPerByte > static_cast<std::int64_t>(size))
    throw Stop{JpegFault::kTruncated};
}

void Walk(File file, std::size_t size, int width_px, int height_px) {
  if (file.Marker() != kStartOfImage) throw Stop{JpegFault::kNoJpeg};
  int components = 0;
  int scans = 0;
  for (int marker = file.Marker(); marker != kEndOfImage; marker = file.Marker()) {
    const Segment segment = file.NextSegment();
    if (IsFrame(marker)) {
      if (components > 0) throw Stop{JpegFault::kNoJpeg};
      components = CheckFrame(marker, segment, width_px, height_px);
      RequireRoom(size, width_px, height_px);
    } else if (marker == kStartOfScan) {
      if (components == 0) throw Stop{JpegFault::kNoJpeg};
      if (++scans > components) throw Stop{JpegFault::kTooManyScans};
      file.SkipScan();
    }
  }
  if (scans == 0) throw Stop{JpegFault::kNoJpeg};
}

}  // namespace

JpegFault CheckJpeg(const std::uint8_t* data, std::size_t size, int width_px, int height_px) {
  try {
    Walk({data, size}, size, width_px, height_px);
  } catch (const Stop& stop) {
    return stop.fault;
  }
  return JpegFault::kNone;
}

std::optional<JpegSize> FindJpegSize(const std::uint8_t* data, std::size_t size) {
  try {
    return FirstFrame({data, size});
  } catch (const Stop&) {
    return std::nullopt;
  }
}

}  // namespace deixis::images
