// One good message, broken one way per test.
#include <gmock/gmock.h>

#include <bot_core/images_t.hpp>
#include <deixis/hand_tracks_t.hpp>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "common/messages/camera_calibration.h"
#include "common/messages/gesture.h"
#include "common/messages/hands.h"
#include "common/messages/image.h"
#include "common/messages/objects.h"

namespace deixis::messages {
namespace {

using bot_core::image_t;

template <typename T>
std::string ReasonFor(const std::vector<std::uint8_t>& bytes) {
  try {
    Header header;
    Codec<T>::Decode({bytes.data(), bytes.size()}, header);
  } catch (const Rejected& rejected) {
    return rejected.what();
  }
  return "accepted";
}

template <typename Message>
std::vector<std::uint8_t> Encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

hand_tracks_t GoodHands() {
  hand_tracks_t message{};
  message.hands.resize(1);
  message.hands[0] = hand_t{};
  message.n_hands = 1;
  return message;
}

image_t GoodJpeg() {
  image_t message{};
  message.width = 8;
  message.height = 6;
  message.pixelformat = image_t::PIXEL_FORMAT_MJPEG;
  cv::imencode(".jpg", cv::Mat(6, 8, CV_8UC3, cv::Scalar(10, 20, 30)), message.data);
  message.size = static_cast<std::int32_t>(message.data.size());
  return message;
}

image_t GoodGrey() {
  image_t message{};
  message.width = 4;
  message.height = 2;
  message.row_stride = 4;
  message.pixelformat = image_t::PIXEL_FORMAT_GRAY;
  message.data.assign(8, 100);
  message.size = 8;
  return message;
}

TEST(HostileHands, GoodOneIsAccepted) {
  EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(GoodHands())), "accepted");
}

TEST(HostileHands, EveryTruncationIsRejected) {
  const auto whole = Encoded(GoodHands());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::vector<std::uint8_t> part(whole.begin(), whole.begin() + static_cast<long>(size));
    EXPECT_NE(ReasonFor<scene::Hands>(part), "accepted") << size;
  }
}

TEST(HostileHands, TrailingBytesAreRejected) {
  auto bytes = Encoded(GoodHands());
  bytes.push_back(0);
  EXPECT_EQ(ReasonFor<scene::Hands>(bytes), "truncated");
}

TEST(HostileHands, AnotherTypeIsRejected) {
  EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(GoodGrey())), "wrong_type");
}

TEST(HostileHands, NotANumberIsRejected) {
  auto message = GoodHands();
  message.hands[0].centre_px[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(message)), "not_finite");
}

TEST(HostileHands, InfinityIsRejected) {
  auto message = GoodHands();
  message.hands[0].covariance[3] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(message)), "not_finite");
}

TEST(HostileHands, UnknownEnumerationsAreRejected) {
  auto message = GoodHands();
  message.hands[0].side = 3;
  EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(message)), "out_of_range");
  message.hands[0].side = -1;
  EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(message)), "out_of_range");
}

TEST(HostileHands, NegativeBoxesAreRejected) {
  auto message = GoodHands();
  message.hands[0].box_px[2] = -1.0;
  EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(message)), "out_of_range");
}

TEST(HostileHands, TooManyAreRejected) {
  auto message = GoodHands();
  message.hands.assign(257, hand_t{});
  message.n_hands = 257;
  EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(message)), "too_many");
}

TEST(HostileImage, GoodOnesAreAccepted) {
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(GoodJpeg())), "accepted");
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(GoodGrey())), "accepted");
  EXPECT_EQ(ReasonFor<images::EncodedImage>(Encoded(GoodJpeg())), "accepted");
}

TEST(HostileImage, JpegOfAnotherSizeIsRejected) {
  auto message = GoodJpeg();
  message.width = 16;
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), "bad_image");
  EXPECT_EQ(ReasonFor<images::EncodedImage>(Encoded(message)), "bad_image");
}

TEST(HostileImage, GarbageInsteadOfJpegIsRejected) {
  auto message = GoodJpeg();
  for (auto& byte : message.data) byte = 0x5A;
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), "bad_image");
}

TEST(HostileImage, JpegThatClaimsGigabytesIsRejectedByItsHeader) {
  auto message = GoodJpeg();
  message.width = message.height = 65000;
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), "too_large");
}

TEST(HostileImage, EmptyPictureIsRejected) {
  auto message = GoodGrey();
  message.height = 0;
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), "bad_image");
}

TEST(HostileImage, FewerBytesThanPixelsAreRejected) {
  auto message = GoodGrey();
  message.height = 3;
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), "bad_image");
}

TEST(HostileImage, RowsThatOverlapAreRejected) {
  auto message = GoodGrey();
  message.row_stride = 3;
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), "bad_image");
}

TEST(HostileImage, UnknownPixelFormatIsRejected) {
  auto message = GoodGrey();
  message.pixelformat = image_t::PIXEL_FORMAT_INVALID;
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), "bad_image");
}

TEST(StereoImage, LeftPictureIsTaken) {
  bot_core::images_t message{};
  message.utime = 77;
  message.image_types = {bot_core::images_t::DEPTH_MM_ZIPPED, bot_core::images_t::LEFT};
  message.images = {GoodGrey(), GoodJpeg()};
  message.n_images = 2;
  message.images[1].utime = 77;
  Header header;
  const auto bytes = Encoded(message);
  const auto image = Codec<images::Image>::Decode({bytes.data(), bytes.size()}, header);
  EXPECT_EQ(image.bgr.cols, 8);
  EXPECT_EQ(image.time.microseconds, 77);
}

TEST(StereoImage, WithoutLeftPictureIsRejected) {
  bot_core::images_t message{};
  message.image_types = {bot_core::images_t::RIGHT};
  message.images = {GoodGrey()};
  message.n_images = 1;
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), "no_left_image");
}

TEST(ImageColours, RedGreenBlueIsTurnedRound) {
  image_t message{};
  message.width = message.height = 1;
  message.pixelformat = image_t::PIXEL_FORMAT_RGB;
  message.data = {1, 2, 3};
  message.size = 3;
  Header header;
  const auto bytes = Encoded(message);
  const auto image = Codec<images::Image>::Decode({bytes.data(), bytes.size()}, header);
  EXPECT_EQ(image.bgr.at<cv::Vec3b>(0, 0), cv::Vec3b(3, 2, 1));
}

TEST(HostileCalibration, SizesThatNoCameraHasAreRejected) {
  geometry::CameraCalibration calibration = geometry::GuessCalibration(640, 480, 1.0);
  calibration.width_px = 0;
  EXPECT_EQ(ReasonFor<geometry::CameraCalibration>(
                Codec<geometry::CameraCalibration>::Encode(calibration, 0)),
            "out_of_range");
}

}  // namespace
}  // namespace deixis::messages
