// What stereo and depth cameras send: there and back, and broken one way per test.
#include <gmock/gmock.h>

#include <bot_core/images_t.hpp>
#include <bot_core/rigid_transform_t.hpp>
#include <cmath>
#include <functional>
#include <kinect/frame_msg_t.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "common/messages/camera_calibration.h"
#include "common/messages/camera_pose.h"
#include "common/messages/rgbd_image.h"
#include "common/messages/stereo_calibration.h"
#include "common/messages/stereo_image.h"
#include "common/messages/stereo_pair.h"

namespace deixis::messages {
namespace {

using bot_core::image_t;
using bot_core::images_t;
using kinect::depth_msg_t;
using kinect::frame_msg_t;
using kinect::image_msg_t;

constexpr Timestamp kTime{1'700'000'000'123'456};

template <typename Message>
std::vector<std::uint8_t> Encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

template <typename T>
T Decode(const std::vector<std::uint8_t>& bytes) {
  return Codec<T>::Decode({bytes.data(), bytes.size()}).value;
}

template <typename T, typename Message>
std::string ReasonFor(const Message& message) {
  try {
    Decode<T>(Encoded(message));
  } catch (const Rejected& rejected) {
    return rejected.what();
  }
  return "accepted";
}

/// The generated message of an encoded struct, changed by `change`.
template <typename Message, typename T>
Message Changed(const T& value, const std::function<void(Message&)>& change) {
  const auto bytes = Codec<T>::Encode(value, 7);
  Message message{};
  message.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
  change(message);
  return message;
}

bool AreEqual(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

cv::Mat Gradient(cv::Size size) {
  cv::Mat bgr(size, CV_8UC3);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      bgr.at<cv::Vec3b>(y, x) = {static_cast<std::uint8_t>(5 * x), static_cast<std::uint8_t>(7 * y),
                                 90};
    }
  }
  return bgr;
}

cv::Mat Ramp(cv::Size size) {
  cv::Mat depth_mm(size, CV_16UC1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      depth_mm.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(700 * y + 13 * x);
    }
  }
  return depth_mm;
}

images::EncodedImage Jpeg(cv::Size size) {
  images::EncodedImage image{kTime, "STEREO", size.width, size.height, {}};
  cv::imencode(".jpg", Gradient(size), image.jpeg);
  return image;
}

images::StereoImage Stereo() { return {Jpeg({16, 12}), Ramp({8, 6})}; }

images::StereoPair Pair() {
  return {{kTime, "left", Gradient({10, 6})}, {kTime, "right", Gradient({10, 6}) / 2}};
}

images::RgbdImage Rgbd() {
  return {{kTime, "kinect", Gradient({16, 12})},
          {{kTime.microseconds + 9}, "kinect", Ramp({8, 6})}};
}

geometry::StereoCalibration Calibration() {
  geometry::StereoCalibration calibration;
  calibration.time = kTime;
  calibration.camera = "STEREO";
  calibration.left = geometry::GuessCalibration(640, 480, 1.0);
  calibration.left.distortion_model = geometry::DistortionModel::kPlumbBob;
  calibration.left.distortion = {0.1, -0.2, 0.001, 0.002, 0.03};
  calibration.right = geometry::GuessCalibration(640, 480, 1.1);
  calibration.rectified = geometry::GuessCalibration(640, 480, 1.05);
  calibration.rectified.parent_frame = "head";
  calibration.rectified.parent_from_camera = {
      Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY())), {0.1, 0.2, 1.4}};
  calibration.right_from_left = {Eigen::Quaterniond(0.8, 0.6, 0.0, 0.0), {-0.12, 0.001, 0.002}};
  calibration.disparity_sigma_px = 0.4;
  calibration.depth_sigma_m_at_1m = 0.003;
  return calibration;
}

template <typename T>
T RoundTrip(const T& value) {
  const auto bytes = Codec<T>::Encode(value, 42);
  const auto decoded = Codec<T>::Decode({bytes.data(), bytes.size()});
  EXPECT_EQ(decoded.sequence, 42);
  EXPECT_EQ(Codec<T>::Time(decoded.value), Codec<T>::Time(value));
  EXPECT_EQ(Codec<T>::Encode(decoded.value, 42), bytes);
  return decoded.value;
}

TEST(StereoImageMessage, GoesThereAndBack) {
  const images::StereoImage decoded = RoundTrip(Stereo());
  EXPECT_EQ(decoded.left.camera, "STEREO");
  EXPECT_EQ(decoded.left.jpeg, Stereo().left.jpeg);
  EXPECT_TRUE(AreEqual(decoded.depth_mm, Stereo().depth_mm));
}

TEST(StereoImageMessage, TakesPartOfALargerDepthImage) {
  images::StereoImage stereo = Stereo();
  stereo.depth_mm = Ramp({20, 20})(cv::Rect(3, 2, 8, 6));
  EXPECT_TRUE(AreEqual(RoundTrip(stereo).depth_mm, stereo.depth_mm));
}

TEST(StereoImageMessage, TakesDepthThatIsNotPacked) {
  const auto message = Changed<images_t>(Stereo(), [](images_t& changed) {
    const cv::Mat depth_mm = Ramp({8, 6});
    changed.image_types[1] = images_t::DEPTH_MM;
    changed.images[1].data.assign(depth_mm.data, depth_mm.data + 96);
    changed.images[1].size = 96;
  });
  EXPECT_TRUE(AreEqual(Decode<images::StereoImage>(Encoded(message)).depth_mm, Ramp({8, 6})));
}

using Change = std::function<void(images_t&)>;

std::string ReasonOfStereo(const Change& change) {
  return ReasonFor<images::StereoImage>(Changed<images_t>(Stereo(), change));
}

TEST(HostileStereoImage, WithoutDepthIsRejected) {
  EXPECT_EQ(ReasonOfStereo([](images_t& m) { m.image_types[1] = images_t::RIGHT; }),
            "no_depth_image");
}

TEST(HostileStereoImage, WithoutLeftIsRejected) {
  EXPECT_EQ(ReasonOfStereo([](images_t& m) { m.image_types[0] = images_t::RIGHT; }),
            "no_left_image");
}

TEST(HostileStereoImage, DepthOfAnotherViewIsRejected) {
  EXPECT_EQ(ReasonOfStereo([](images_t& m) { m.images[1].width = 6; }), "depth_of_other_view");
}

TEST(HostileStereoImage, DepthThatUnpacksToMoreThanItsSizeIsRejected) {
  EXPECT_EQ(ReasonOfStereo([](images_t& m) {
              m.images[1].width = 4;
              m.images[1].height = 3;
              m.images[1].row_stride = 8;
            }),
            "zlib_too_long");
}

TEST(HostileStereoImage, DepthThatUnpacksToLessThanItsSizeIsRejected) {
  EXPECT_EQ(ReasonOfStereo([](images_t& m) {
              m.images[1].width = 16;
              m.images[1].height = 12;
              m.images[1].row_stride = 32;
            }),
            "zlib_too_short");
}

TEST(HostileStereoImage, DamagedDepthIsRejected) {
  EXPECT_EQ(ReasonOfStereo([](images_t& m) { m.images[1].data[0] ^= 0xFF; }), "zlib_damaged");
}

TEST(HostileStereoImage, DepthWhoseRowsHaveGapsIsRejected) {
  EXPECT_EQ(ReasonOfStereo([](images_t& m) { m.images[1].row_stride = 20; }), "bad_row_stride");
}

TEST(HostileStereoImage, AbsurdSizesAreRejectedBeforeMemoryIsTaken) {
  EXPECT_EQ(
      ReasonOfStereo([](images_t& m) { m.images[1].width = m.images[1].height = 2'000'000'000; }),
      "too_large");
  EXPECT_EQ(ReasonOfStereo([](images_t& m) { m.images[1].height = 0; }), "bad_image_size");
}

TEST(HostileStereoImage, APictureThatLiesAboutItsSizeIsRejected) {
  EXPECT_EQ(ReasonOfStereo([](images_t& m) { m.images[0].width = 8000; }), "jpeg_size");
}

TEST(StereoPairMessage, GoesThereAndBackRaw) {
  const images::StereoPair decoded = RoundTrip(Pair());
  EXPECT_TRUE(AreEqual(decoded.left.bgr, Pair().left.bgr));
  EXPECT_TRUE(AreEqual(decoded.right.bgr, Pair().right.bgr));
  EXPECT_EQ(decoded.right.camera, "right");
}

TEST(StereoPairMessage, GoesThereAndBackAsJpeg) {
  const images::EncodedStereoPair pair{Jpeg({16, 12}), Jpeg({16, 12})};
  EXPECT_EQ(RoundTrip(pair).right.jpeg, pair.right.jpeg);
  const auto bytes = Codec<images::EncodedStereoPair>::Encode(pair, 3);
  EXPECT_EQ(Decode<images::StereoPair>(bytes).left.bgr.cols, 16);
}

TEST(HostileStereoPair, PicturesOfTwoSizesAreRejected) {
  const auto message = Changed<images_t>(Pair(), [](images_t& m) { m.images[1].height = 5; });
  EXPECT_EQ(ReasonFor<images::StereoPair>(message), "pair_of_two_sizes");
}

TEST(HostileStereoPair, WithoutRightIsRejected) {
  const auto message =
      Changed<images_t>(Pair(), [](images_t& m) { m.image_types[1] = images_t::DISPARITY; });
  EXPECT_EQ(ReasonFor<images::StereoPair>(message), "no_right_image");
}

TEST(StereoCalibrationMessage, GoesThereAndBack) {
  const geometry::StereoCalibration decoded = RoundTrip(Calibration());
  EXPECT_EQ(decoded.left.distortion, Calibration().left.distortion);
  EXPECT_EQ(decoded.right.focal_px, Calibration().right.focal_px);
  EXPECT_EQ(decoded.rectified.parent_frame, "head");
  EXPECT_TRUE(decoded.rectified.parent_from_camera->rotation.isApprox(
      Calibration().rectified.parent_from_camera->rotation));
  EXPECT_FALSE(decoded.left.parent_from_camera);
  EXPECT_EQ(decoded.right_from_left.translation_m, Eigen::Vector3d(-0.12, 0.001, 0.002));
  EXPECT_EQ(decoded.disparity_sigma_px, 0.4);
}

TEST(StereoCalibrationMessage, SpeaksOfItsPublishedPictureToThoseWhoWantOneLens) {
  const geometry::StereoCalibration calibration = Calibration();
  const auto bytes = Codec<geometry::StereoCalibration>::Encode(calibration, 7);
  const auto [lens, sequence] =
      Codec<geometry::CameraCalibration>::Decode({bytes.data(), bytes.size()});
  EXPECT_EQ(sequence, 7);
  EXPECT_EQ(lens.camera, calibration.camera);
  EXPECT_EQ(lens.time, calibration.time);
  EXPECT_EQ(lens.focal_px, calibration.rectified.focal_px);
}

TEST(HostileStereoCalibration, RotationsThatAreNoneAreRejected) {
  geometry::StereoCalibration calibration = Calibration();
  calibration.right_from_left.rotation.coeffs() *= 1.01;
  const auto bytes = Codec<geometry::StereoCalibration>::Encode(calibration, 0);
  EXPECT_THAT([&] { Decode<geometry::StereoCalibration>(bytes); },
              testing::ThrowsMessage<Rejected>("not_a_rotation"));
}

TEST(HostileStereoCalibration, NegativeSpreadsAreRejected) {
  geometry::StereoCalibration calibration = Calibration();
  calibration.disparity_sigma_px = -0.1;
  const auto bytes = Codec<geometry::StereoCalibration>::Encode(calibration, 0);
  EXPECT_THAT([&] { Decode<geometry::StereoCalibration>(bytes); },
              testing::ThrowsMessage<Rejected>("out_of_range"));
}

TEST(RgbdMessage, GoesThereAndBack) {
  const auto bytes = Codec<images::RgbdImage>::Encode(Rgbd(), 0);
  const auto decoded = Decode<images::RgbdImage>(bytes);
  EXPECT_TRUE(AreEqual(decoded.colour.bgr, Rgbd().colour.bgr));
  EXPECT_TRUE(AreEqual(decoded.depth.depth_mm, Rgbd().depth.depth_mm));
  EXPECT_EQ(decoded.colour.time, kTime);
  EXPECT_EQ(decoded.depth.time.microseconds, kTime.microseconds + 9);
  EXPECT_TRUE(decoded.is_registered);
}

std::string ReasonOfKinect(const std::function<void(frame_msg_t&)>& change) {
  return ReasonFor<images::RgbdImage>(Changed<frame_msg_t>(Rgbd(), change));
}

TEST(RgbdMessage, TakesTheSensorsOwn11Bits) {
  const auto message = Changed<frame_msg_t>(Rgbd(), [](frame_msg_t& m) {
    const std::uint16_t raw[] = {2047, 0, 800, 1000};
    m.depth.width = m.depth.height = 2;
    m.depth.depth_data_format = depth_msg_t::DEPTH_11BIT;
    m.depth.compression = depth_msg_t::COMPRESSION_NONE;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(raw);
    m.depth.depth_data.assign(bytes, bytes + sizeof(raw));
    m.depth.depth_data_nbytes = sizeof(raw);
  });
  const auto decoded = Decode<images::RgbdImage>(Encoded(message));
  const cv::Mat& depth_mm = decoded.depth.depth_mm;
  EXPECT_EQ(depth_mm.at<std::uint16_t>(0, 0), 0);
  // Worked by hand from the published fit.
  EXPECT_NEAR(depth_mm.at<std::uint16_t>(1, 0), 1195, 1);
  EXPECT_NEAR(depth_mm.at<std::uint16_t>(1, 1), 3779, 1);
  EXPECT_FALSE(decoded.is_registered);
}

TEST(HostileRgbd, NegativeSizesAreRejected) {
  EXPECT_EQ(ReasonOfKinect([](frame_msg_t& m) { m.depth.width = -8; }), "bad_image_size");
  EXPECT_EQ(ReasonOfKinect([](frame_msg_t& m) { m.image.height = -1; }), "bad_image_size");
}

TEST(HostileRgbd, MissingPicturesAreNamed) {
  EXPECT_EQ(
      ReasonOfKinect([](frame_msg_t& m) { m.depth.depth_data_format = depth_msg_t::DEPTH_NONE; }),
      "no_depth_image");
  EXPECT_EQ(
      ReasonOfKinect([](frame_msg_t& m) { m.image.image_data_format = image_msg_t::VIDEO_NONE; }),
      "no_colour_image");
}

TEST(HostileRgbd, FormatsThatNobodyKnowsAreNamed) {
  EXPECT_EQ(ReasonOfKinect([](frame_msg_t& m) { m.depth.compression = 9; }), "bad_pixel_format");
  EXPECT_EQ(ReasonOfKinect([](frame_msg_t& m) { m.image.image_data_format = 55; }),
            "bad_pixel_format");
}

TEST(HostileRgbd, PixelsThatAreNotThereAreNotRead) {
  EXPECT_EQ(ReasonOfKinect([](frame_msg_t& m) { m.image.width = 17; }), "too_few_pixels");
  EXPECT_EQ(ReasonOfKinect([](frame_msg_t& m) { m.depth.height = 7; }), "zlib_too_short");
}

bot_core::rigid_transform_t RobotPose() {
  bot_core::rigid_transform_t message{};
  message.utime = kTime.microseconds;
  const double translation_m[3] = {0.1, -0.2, 1.4};
  const double rotation_wxyz[4] = {0.5, -0.5, 0.5, -0.5};  // optical: z forward, x right
  std::copy(std::begin(translation_m), std::end(translation_m), message.trans);
  std::copy(std::begin(rotation_wxyz), std::end(rotation_wxyz), message.quat);
  return message;
}

TEST(CameraPose, PutsWhatIsInFrontOfTheCameraInFrontOfTheRobot) {
  const auto pose = Decode<geometry::CameraPose>(Encoded(RobotPose()));
  EXPECT_EQ(pose.time, kTime);
  const Eigen::Vector3d in_parent = pose.parent_from_camera * Eigen::Vector3d(0.0, 0.0, 2.0);
  EXPECT_TRUE(in_parent.isApprox(Eigen::Vector3d(2.1, -0.2, 1.4), 1e-12)) << in_parent.transpose();
}

TEST(CameraPose, GoesThereAndBackWithTheSameBytes) {
  const auto bytes = Encoded(RobotPose());
  EXPECT_EQ(Codec<geometry::CameraPose>::Encode(Decode<geometry::CameraPose>(bytes), 7), bytes);
  EXPECT_EQ(Codec<geometry::CameraPose>::Decode({bytes.data(), bytes.size()}).sequence, -1);
}

TEST(HostileCameraPose, WhatIsNoPlaceIsRejected) {
  const auto reason = [](void (*change)(bot_core::rigid_transform_t&)) {
    auto message = RobotPose();
    change(message);
    return ReasonFor<geometry::CameraPose>(message);
  };
  EXPECT_EQ(reason([](auto&) {}), "accepted");
  EXPECT_EQ(reason([](auto& m) { m.quat[0] = 0.6; }), "not_a_rotation");
  EXPECT_EQ(reason([](auto& m) { m.quat[1] = std::nan(""); }), "not_finite");
  EXPECT_EQ(reason([](auto& m) { m.trans[2] = INFINITY; }), "not_finite");
  EXPECT_EQ(reason([](auto& m) { m.trans[0] = 1e9; }), "out_of_range");
  EXPECT_EQ(reason([](auto& m) { m.utime = -1; }), "out_of_range");
}

}  // namespace
}  // namespace deixis::messages
