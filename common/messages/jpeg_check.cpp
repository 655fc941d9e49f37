#include "common/messages/jpeg_check.h"

#include <cstring>

namespace deixis::messages {
namespace {

// Table B.1.
constexpr int kStartOfImage = 0xD8;
constexpr int kEndOfImage = 0xD9;
constexpr int kStartOfScan = 0xDA;
constexpr int kBaseline = 0xC0;
constexpr int kSequential = 0xC1;
// An 8 x 8 block takes a code for its mean and one for its end, one bit each at least.
constexpr std::int64_t kMostPixelsPerByte = 256;

bool IsFrame(int marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

bool IsWithinScan(int second) { return second == 0 || (second >= 0xD0 && second <= 0xD7); }

class File {
 public:
  explicit File(Bytes bytes) : at_(bytes.data), left_(bytes.size) {}

  // The next marker; it stands where this is.
  int Marker() {
    if (Byte() != 0xFF) throw Rejected("bad_jpeg");
    int marker = 0xFF;
    while (marker == 0xFF) marker = Byte();
    return marker;
  }

  // What stands behind a marker, without its length.
  Bytes Segment() {
    const int size = Byte() << 8;
    const int whole = size | Byte();
    if (whole < 2) throw Rejected("bad_jpeg");
    const auto content = static_cast<std::size_t>(whole - 2);
    if (content > left_) throw Rejected("jpeg_truncated");
    const Bytes segment{at_, content};
    Skip(content);
    return segment;
  }

  // To the marker that ends the coded pixels.
  void SkipScan() {
    for (;;) {
      const auto* marker =
          left_ == 0 ? nullptr : static_cast<const std::uint8_t*>(std::memchr(at_, 0xFF, left_));
      if (marker == nullptr) throw Rejected("jpeg_truncated");
      Skip(static_cast<std::size_t>(marker - at_));
      if (left_ < 2) throw Rejected("jpeg_truncated");
      if (!IsWithinScan(at_[1])) return;
      Skip(2);
    }
  }

 private:
  int Byte() {
    if (left_ == 0) throw Rejected("jpeg_truncated");
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

// The frame's size is that of the message; returns its number of components.
int CheckFrame(int marker, Bytes frame, int width_px, int height_px) {
  if (marker != kBaseline && marker != kSequential) throw Rejected("jpeg_not_baseline");
  if (frame.size < 6) throw Rejected("bad_jpeg");
  const int height = frame.data[1] << 8 | frame.data[2];
  const int width = frame.data[3] << 8 | frame.data[4];
  if (width != width_px || height != height_px) throw Rejected("jpeg_size");
  return frame.data[5];
}

}  // namespace

void RequireHonestJpeg(Bytes jpeg, int width_px, int height_px) {
  File file(jpeg);
  if (file.Marker() != kStartOfImage) throw Rejected("bad_jpeg");
  int components = 0;
  int scans = 0;
  for (int marker = file.Marker(); marker != kEndOfImage; marker = file.Marker()) {
    const Bytes segment = file.Segment();
    if (IsFrame(marker)) {
      if (components > 0) throw Rejected("bad_jpeg");
      components = CheckFrame(marker, segment, width_px, height_px);
      const std::int64_t pixels = std::int64_t{width_px} * height_px;
      const bool can_hold = pixels / kMostPixelsPerByte <= static_cast<std::int64_t>(jpeg.size);
      if (!can_hold) throw Rejected("jpeg_truncated");
    } else if (marker == kStartOfScan) {
      if (components == 0) throw Rejected("bad_jpeg");
      if (++scans > components) throw Rejected("jpeg_too_many_scans");
      file.SkipScan();
    }
  }
  if (scans == 0) throw Rejected("bad_jpeg");
}

}  // namespace deixis::messages
