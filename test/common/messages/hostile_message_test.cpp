// One good message, broken one way per test.
#include <gmock/gmock.h>

#include <bot_core/images_t.hpp>
#include <cmath>
#include <deixis/gesture_state_t.hpp>
#include <deixis/gesture_t.hpp>
#include <deixis/hand_tracks_t.hpp>
#include <deixis/objects_t.hpp>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "common/messages/camera_calibration.h"
#include "common/messages/gesture.h"
#include "common/messages/gesture_state.h"
#include "common/messages/hands.h"
#include "common/messages/image.h"
#include "common/messages/objects.h"

namespace deixis::messages {
namespace {

using bot_core::image_t;

template <typename T>
std::string ReasonFor(const std::vector<std::uint8_t>& bytes) {
  try {
    Codec<T>::Decode({bytes.data(), bytes.size()});
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
    EXPECT_EQ(ReasonFor<scene::Hands>(part), "truncated") << size;
  }
}

TEST(HostileHands, TrailingBytesAreRejected) {
  auto bytes = Encoded(GoodHands());
  bytes.push_back(0);
  EXPECT_EQ(ReasonFor<scene::Hands>(bytes), "trailing_bytes");
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

TEST(HostileHands, PlacesFarBeyondAnyPictureAreRejected) {
  for (const double absurd : {1.1e6, -1e300}) {
    auto message = GoodHands();
    message.hands[0].box_px[2] = std::abs(absurd);
    EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(message)), "out_of_range");
    message = GoodHands();
    message.hands[0].centre_px[0] = absurd;
    EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(message)), "out_of_range");
    message = GoodHands();
    message.hands[0].velocity_px_per_s[1] = absurd;
    EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(message)), "out_of_range");
    message = GoodHands();
    message.hands[0].covariance[0] = absurd * absurd;
    EXPECT_NE(ReasonFor<scene::Hands>(Encoded(message)), "accepted");
  }
}

TEST(HostileHands, PlacesFarBeyondAnyRoomAreRejected) {
  auto message = GoodHands();
  message.hands[0].has_position = 1;
  EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(message)), "accepted");
  message.hands[0].position_m[2] = 1e200;
  EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(message)), "out_of_range");
}

TEST(HostileHands, NegativeVariancesAreRejected) {
  auto message = GoodHands();
  message.hands[0].covariance[2] = -1.0;
  EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(message)), "out_of_range");
}

TEST(HostileHands, CameraNamesOfAbsurdLengthAreRejected) {
  auto message = GoodHands();
  message.camera.assign(1024, 'c');
  EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(message)), "accepted");
  message.camera.push_back('c');
  EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(message)), "text_too_long");
}

TEST(HostileHands, TimesAndNumbersThatCannotBeAreRejected) {
  for (const std::int64_t absurd : {std::int64_t{-1}, std::numeric_limits<std::int64_t>::min(),
                                    std::numeric_limits<std::int64_t>::max()}) {
    auto message = GoodHands();
    message.utime = absurd;
    EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(message)), "out_of_range") << absurd;
    message = GoodHands();
    message.sequence = absurd;
    EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(message)), "out_of_range") << absurd;
  }
}

TEST(HostileHands, TooManyAreRejected) {
  auto message = GoodHands();
  message.hands.assign(257, hand_t{});
  message.n_hands = 257;
  EXPECT_EQ(ReasonFor<scene::Hands>(Encoded(message)), "too_many");
}

objects_t GoodFace() {
  objects_t message{};
  message.objects.resize(1);
  object_t& face = message.objects[0] = object_t{};
  face.kind = static_cast<std::int8_t>(scene::ObjectKind::kFace);
  face.has_box = true;
  face.box_px[2] = face.box_px[3] = 40.0;
  face.score = 1.0;
  message.n_objects = 1;
  return message;
}

TEST(HostileObjects, GoodOneIsAccepted) {
  EXPECT_EQ(ReasonFor<scene::Objects>(Encoded(GoodFace())), "accepted");
}

TEST(HostileObjects, FacesSmallerThanAPixelAreRejected) {
  auto message = GoodFace();
  message.objects[0].box_px[3] = 1e-300;
  EXPECT_EQ(ReasonFor<scene::Objects>(Encoded(message)), "out_of_range");
}

TEST(HostileObjects, ScoresThatAreNoProbabilityAreRejected) {
  auto message = GoodFace();
  message.objects[0].score = 1.5;
  EXPECT_EQ(ReasonFor<scene::Objects>(Encoded(message)), "out_of_range");
}

TEST(HostileObjects, LabelsOfAbsurdLengthAreRejected) {
  auto message = GoodFace();
  message.objects[0].label.assign(1025, 'x');
  EXPECT_EQ(ReasonFor<scene::Objects>(Encoded(message)), "text_too_long");
}

TEST(HostileObjects, TimesOfLastSightThatCannotBeAreRejected) {
  auto message = GoodFace();
  message.objects[0].last_seen_utime = -5;
  EXPECT_EQ(ReasonFor<scene::Objects>(Encoded(message)), "out_of_range");
}

TEST(HostileGestures, PhasesThatAreNoShareAreRejected) {
  gesture_state_t message{};
  message.hypotheses.resize(1);
  message.hypotheses[0] = gesture_hypothesis_t{};
  message.n_hypotheses = 1;
  EXPECT_EQ(ReasonFor<scene::GestureState>(Encoded(message)), "accepted");
  message.hypotheses[0].phase = 1.1;
  EXPECT_EQ(ReasonFor<scene::GestureState>(Encoded(message)), "out_of_range");
}

TEST(HostileGestures, ContextAreasFarBeyondAnyPictureAreRejected) {
  gesture_state_t good{};
  good.hypotheses.resize(1);
  good.hypotheses[0] = gesture_hypothesis_t{};
  good.hypotheses[0].has_context = true;
  good.n_hypotheses = 1;
  EXPECT_EQ(ReasonFor<scene::GestureState>(Encoded(good)), "accepted");
  auto message = good;
  message.hypotheses[0].context_radius_px = 1e300;
  EXPECT_EQ(ReasonFor<scene::GestureState>(Encoded(message)), "out_of_range");
  message = good;
  message.hypotheses[0].context_end_rad = 1e300;
  EXPECT_EQ(ReasonFor<scene::GestureState>(Encoded(message)), "out_of_range");
}

TEST(HostileGestures, TimesThatCannotBeAreRejected) {
  gesture_t message{};
  EXPECT_EQ(ReasonFor<scene::Gesture>(Encoded(message)), "accepted");
  message.start_utime = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(ReasonFor<scene::Gesture>(Encoded(message)), "out_of_range");
}

TEST(HostileImage, GoodOnesAreAccepted) {
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(GoodJpeg())), "accepted");
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(GoodGrey())), "accepted");
  EXPECT_EQ(ReasonFor<images::EncodedImage>(Encoded(GoodJpeg())), "accepted");
}

// Results repeat the name of the camera, so a bad one would spoil every message of ours.
TEST(HostileImage, CameraNamesThatAreNoTextAreRejected) {
  for (const auto& [name, reason] : std::vector<std::pair<std::vector<std::uint8_t>, std::string>>{
           {{'C', 0, 'D'}, "bad_string"},
           {{0xFF}, "bad_string"},
           {std::vector<std::uint8_t>(1025, 'C'), "text_too_long"}}) {
    auto message = GoodGrey();
    message.metadata = {{}};
    message.metadata[0].key = "deixis.camera";
    message.metadata[0].value = name;
    message.metadata[0].n = static_cast<std::int32_t>(name.size());
    message.nmetadata = 1;
    EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), reason);
  }
}

TEST(HostileImage, JpegOfAnotherSizeIsRejected) {
  auto message = GoodJpeg();
  message.width = 16;
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), "jpeg_size");
  EXPECT_EQ(ReasonFor<images::EncodedImage>(Encoded(message)), "jpeg_size");
}

TEST(HostileImage, SidesThatOpenCvCannotWorkOnAreRejected) {
  auto message = GoodGrey();
  message.data.assign(40'000, 0);
  message.size = 40'000;
  message.row_stride = 0;
  message.height = 1;
  message.width = 32'766;
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), "accepted");
  message.width = 32'767;
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), "too_large");
}

TEST(HostileImage, GarbageInsteadOfJpegIsRejected) {
  auto message = GoodJpeg();
  for (auto& byte : message.data) byte = 0x5A;
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), "bad_jpeg");
}

TEST(HostileImage, JpegThatClaimsGigabytesIsRejectedByItsHeader) {
  auto message = GoodJpeg();
  message.width = message.height = 65000;
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), "too_large");
}

TEST(HostileImage, EmptyPictureIsRejected) {
  auto message = GoodGrey();
  message.height = 0;
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), "bad_image_size");
}

TEST(HostileImage, FewerBytesThanPixelsAreRejected) {
  auto message = GoodGrey();
  message.height = 3;
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), "too_few_pixels");
}

TEST(HostileImage, RowsThatOverlapAreRejected) {
  auto message = GoodGrey();
  message.row_stride = 3;
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), "bad_row_stride");
}

TEST(HostileImage, UnknownPixelFormatIsRejected) {
  auto message = GoodGrey();
  message.pixelformat = image_t::PIXEL_FORMAT_INVALID;
  EXPECT_EQ(ReasonFor<images::Image>(Encoded(message)), "bad_pixel_format");
}

TEST(StereoImage, LeftPictureIsTaken) {
  bot_core::images_t message{};
  message.utime = 77;
  message.image_types = {bot_core::images_t::DEPTH_MM_ZIPPED, bot_core::images_t::LEFT};
  message.images = {GoodGrey(), GoodJpeg()};
  message.n_images = 2;
  message.images[1].utime = 75;  // As its camera stamped it.
  const auto bytes = Encoded(message);
  const auto image = Codec<images::Image>::Decode({bytes.data(), bytes.size()}).value;
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
  const auto bytes = Encoded(message);
  const auto image = Codec<images::Image>::Decode({bytes.data(), bytes.size()}).value;
  EXPECT_EQ(image.bgr.at<cv::Vec3b>(0, 0), cv::Vec3b(3, 2, 1));
}

TEST(HostileCalibration, FocalLengthsThatNoCameraHasAreRejected) {
  geometry::CameraCalibration calibration = geometry::GuessCalibration(640, 480, 1.0);
  for (const double focal_px : {1e-300, 0.0, -500.0, 2e6}) {
    calibration.focal_px.y() = focal_px;
    EXPECT_EQ(ReasonFor<geometry::CameraCalibration>(
                  Codec<geometry::CameraCalibration>::Encode(calibration, 0)),
              "out_of_range");
  }
}

std::string ReasonForLens(const geometry::CameraCalibration& calibration) {
  return ReasonFor<geometry::CameraCalibration>(
      Codec<geometry::CameraCalibration>::Encode(calibration, 0));
}

TEST(HostileCalibration, CoefficientsThatDoNotFitTheirModelAreRejected) {
  geometry::CameraCalibration calibration = geometry::GuessCalibration(640, 480, 1.0);
  calibration.distortion_model = geometry::DistortionModel::kPlumbBob;
  calibration.distortion.assign(5, 0.1);
  EXPECT_EQ(ReasonForLens(calibration), "accepted");
  calibration.distortion[4] = 1e300;
  EXPECT_EQ(ReasonForLens(calibration), "out_of_range");
  calibration.distortion.assign(3, 0.1);
  EXPECT_EQ(ReasonForLens(calibration), "out_of_range");
  calibration.distortion.assign(15, 0.1);
  EXPECT_EQ(ReasonForLens(calibration), "too_many");
}

TEST(HostileCalibration, RectificationsThatAreNoRotationAreRejected) {
  geometry::CameraCalibration calibration = geometry::GuessCalibration(640, 480, 1.0);
  calibration.rectification *= -1.0;
  EXPECT_EQ(ReasonForLens(calibration), "out_of_range");
  calibration.rectification.setZero();
  EXPECT_EQ(ReasonForLens(calibration), "out_of_range");
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
