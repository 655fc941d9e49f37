#include "common/images/jpeg_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace deixis::images {
namespace {

using File = std::vector<std::uint8_t>;

File Jpeg(const std::vector<int>& options = {}) {
  cv::Mat picture(48, 64, CV_8UC3);
  cv::randu(picture, 0, 255);
  File file;
  cv::imencode(".jpg", picture, file, options);
  return file;
}

JpegFault FaultOf(const File& file, int width_px = 64, int height_px = 48) {
  return CheckJpeg(file.data(), file.size(), width_px, height_px);
}

// Where the segment of a marker begins.
std::size_t Find(const File& file, std::uint8_t marker) {
  const File wanted{0xFF, marker};
  return static_cast<std::size_t>(
      std::search(file.begin(), file.end(), wanted.begin(), wanted.end()) - file.begin());
}

constexpr std::uint8_t kFrame = 0xC0;
constexpr std::uint8_t kScan = 0xDA;

TEST(JpegCheck, AcceptsGoodFiles) {
  EXPECT_EQ(FaultOf(Jpeg()), JpegFault::kNone);
  EXPECT_EQ(FaultOf(Jpeg({cv::IMWRITE_JPEG_RST_INTERVAL, 2})), JpegFault::kNone);
  EXPECT_EQ(FaultOf(Jpeg({cv::IMWRITE_JPEG_OPTIMIZE, 1})), JpegFault::kNone);
}

TEST(JpegCheck, AcceptsThePlainestPicture) {
  File file;
  cv::imencode(".jpg", cv::Mat::zeros(1080, 1920, CV_8UC1), file,
               {cv::IMWRITE_JPEG_OPTIMIZE, 1, cv::IMWRITE_JPEG_QUALITY, 1});
  EXPECT_EQ(FaultOf(file, 1920, 1080), JpegFault::kNone);
}

TEST(JpegCheck, AcceptsWhatSomeCamerasPutBehindTheEnd) {
  File file = Jpeg();
  file.insert(file.end(), 100, 0);
  EXPECT_EQ(FaultOf(file), JpegFault::kNone);
}

TEST(JpegCheck, RefusesAnotherSize) {
  EXPECT_EQ(FaultOf(Jpeg(), 48, 64), JpegFault::kOtherSize);
  File file = Jpeg();
  file[Find(file, kFrame) + 5] = 0x20;  // height
  EXPECT_EQ(FaultOf(file), JpegFault::kOtherSize);
}

TEST(JpegCheck, RefusesEveryTruncation) {
  const File whole = Jpeg();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const File part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    ASSERT_EQ(FaultOf(part), JpegFault::kTruncated) << size;
  }
}

TEST(JpegCheck, RefusesProgressiveFiles) {
  EXPECT_EQ(FaultOf(Jpeg({cv::IMWRITE_JPEG_PROGRESSIVE, 1})), JpegFault::kNotBaseline);
}

// An honest header, and nothing like enough bytes: each would cost a picture of 192 MB.
TEST(JpegCheck, RefusesFewerBytesThanSoManyPixelsTake) {
  File file = Jpeg();
  const std::size_t frame = Find(file, kFrame);
  file[frame + 5] = file[frame + 7] = 0x1F;
  file[frame + 6] = file[frame + 8] = 0x40;
  EXPECT_EQ(FaultOf(file, 8000, 8000), JpegFault::kTruncated);
}

TEST(JpegCheck, RefusesScansWithoutEnd) {
  File file = Jpeg();
  const std::size_t scan = Find(file, kScan);
  const File header(file.begin() + static_cast<std::ptrdiff_t>(scan),
                    file.begin() + static_cast<std::ptrdiff_t>(scan + 14));
  for (int i = 0; i < 1000; ++i) file.insert(file.end() - 2, header.begin(), header.end());
  EXPECT_EQ(FaultOf(file), JpegFault::kTooManyScans);
}

TEST(JpegCheck, RefusesWhatIsNoJpeg) {
  EXPECT_EQ(FaultOf(File(100, 0x5A)), JpegFault::kNoJpeg);
  EXPECT_EQ(FaultOf({0xFF, 0xD8, 0xFF, 0xD9}), JpegFault::kNoJpeg);
  File two_frames = Jpeg();
  const auto frame = two_frames.begin() + static_cast<std::ptrdiff_t>(Find(two_frames, kFrame));
  const File copy(frame, frame + 19);
  two_frames.insert(frame, copy.begin(), copy.end());
  EXPECT_EQ(FaultOf(two_frames), JpegFault::kNoJpeg);
}

TEST(JpegCheck, RefusesPixelsBeforeTheirFrame) {
  File file = Jpeg();
  const auto frame = file.begin() + static_cast<std::ptrdiff_t>(Find(file, kFrame));
  file.erase(frame, frame + 19);
  EXPECT_EQ(FaultOf(file), JpegFault::kNoJpeg);
}

}  // namespace
}  // namespace deixis::images
