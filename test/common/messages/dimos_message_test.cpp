// What dimos robots send: known values there, and one good message broken one way per test.
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sensor_msgs/CameraInfo.hpp>
#include <sensor_msgs/CompressedImage.hpp>
#include <sensor_msgs/Image.hpp>
#include <tf2_msgs/TFMessage.hpp>

#include "common/messages/camera_calibration.h"
#include "common/messages/depth_image.h"
#include "common/messages/frame_transforms.h"
#include "common/messages/image.h"

namespace deixis::messages {
namespace {

using geometry::CameraCalibration;
using geometry::DistortionModel;
using geometry::FrameTransforms;
using sensor_msgs::CameraInfo;
using sensor_msgs::CompressedImage;
using testing::ElementsAre;
using tf2_msgs::TFMessage;

template <typename Message>
std::vector<std::uint8_t> Encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

template <typename T, typename Message>
Decoded<T> Decode(const Message& message) {
  const auto bytes = Encoded(message);
  return Codec<T>::Decode({bytes.data(), bytes.size()});
}

template <typename T, typename Message>
std::string ReasonFor(const Message& message) {
  try {
    Decode<T>(message);
  } catch (const Rejected& rejected) {
    return rejected.what();
  }
  return "accepted";
}

std_msgs::Header Header() {
  std_msgs::Header header{};
  header.seq = 5;
  header.stamp.sec = 1'700'000'000;
  header.stamp.nsec = 123'456'789;
  header.frame_id = "camera_optical";
  return header;
}

sensor_msgs::Image Picture(const std::string& encoding, int width, int height,
                           const std::vector<std::uint8_t>& data) {
  sensor_msgs::Image message{};
  message.header = Header();
  message.width = width;
  message.height = height;
  message.encoding = encoding;
  message.step = height > 0 ? static_cast<std::int32_t>(data.size()) / height : 0;
  message.data = data;
  message.data_length = static_cast<std::int32_t>(data.size());
  return message;
}

// Two pixels, red 200, green 100, blue 50, in every layout.
sensor_msgs::Image TwoPixels() { return Picture("rgb8", 2, 1, {200, 100, 50, 200, 100, 50}); }

std::vector<std::uint8_t> Jpeg() {
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", cv::Mat(6, 8, CV_8UC3, cv::Scalar(50, 100, 200)), jpeg);
  return jpeg;
}

CompressedImage Compressed(const std::string& format) {
  CompressedImage message{};
  message.header = Header();
  message.format = format;
  message.data = Jpeg();
  message.data_length = static_cast<std::int32_t>(message.data.size());
  return message;
}

CameraInfo Lens() {
  CameraInfo message{};
  message.header = Header();
  message.width = 640;
  message.height = 480;
  message.distortion_model = "plumb_bob";
  message.D = {0.1, -0.2, 0.001, 0.002, 0.03};
  message.D_length = 5;
  const double k[9] = {500, 0, 320, 0, 510, 240, 0, 0, 1};
  std::copy(std::begin(k), std::end(k), std::begin(message.K));
  for (const int i : {0, 4, 8}) message.R[i] = 1.0;
  return message;
}

template <typename Value>
std::vector<std::uint8_t> BytesOf(const std::vector<Value>& values) {
  std::vector<std::uint8_t> bytes(values.size() * sizeof(Value));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::vector<std::uint16_t> DepthOf(const sensor_msgs::Image& message) {
  const cv::Mat depth_mm = Decode<images::DepthImage>(message).value.depth_mm;
  return {depth_mm.begin<std::uint16_t>(), depth_mm.end<std::uint16_t>()};
}

TEST(DimosImage, KeepsTimeToTheMicrosecondAndFrame) {
  const auto decoded = Decode<images::Image>(TwoPixels());
  EXPECT_EQ(decoded.value.time.microseconds, 1'700'000'000'123'456);
  EXPECT_EQ(decoded.value.camera, "camera_optical");
  EXPECT_EQ(decoded.sequence, -1);
}

TEST(DimosImage, EveryEncodingGivesTheSameColour) {
  const std::vector<sensor_msgs::Image> pictures = {
      TwoPixels(),
      Picture("bgr8", 2, 1, {50, 100, 200, 50, 100, 200}),
      Picture("rgba8", 2, 1, {200, 100, 50, 9, 200, 100, 50, 9}),
      Picture("bgra8", 2, 1, {50, 100, 200, 9, 50, 100, 200, 9}),
      Picture("yuv422_yuy2", 2, 1, {123, 91, 123, 175}),
      Picture("yuyv", 2, 1, {123, 91, 123, 175}),
      Picture("yuv422", 2, 1, {91, 123, 175, 123}),
      Picture("jpeg", 8, 6, Jpeg()),
  };
  for (const auto& picture : pictures) {
    const cv::Mat bgr = Decode<images::Image>(picture).value.bgr;
    ASSERT_EQ(bgr.size(), cv::Size(picture.width, picture.height)) << picture.encoding;
    const cv::Scalar mean = cv::mean(bgr);
    EXPECT_NEAR(mean[0], 50, 3) << picture.encoding;
    EXPECT_NEAR(mean[1], 100, 3) << picture.encoding;
    EXPECT_NEAR(mean[2], 200, 3) << picture.encoding;
  }
}

TEST(DimosImage, GreyIsGreyInEveryChannel) {
  const cv::Mat bgr = Decode<images::Image>(Picture("mono8", 2, 1, {7, 250})).value.bgr;
  EXPECT_EQ(bgr.at<cv::Vec3b>(0, 0), cv::Vec3b(7, 7, 7));
  EXPECT_EQ(bgr.at<cv::Vec3b>(0, 1), cv::Vec3b(250, 250, 250));
}

TEST(DimosImage, PassesOverTheGapBehindARow) {
  const cv::Mat bgr = Decode<images::Image>(Picture("mono8", 1, 2, {7, 99, 8, 99})).value.bgr;
  EXPECT_EQ(bgr.at<cv::Vec3b>(1, 0), cv::Vec3b(8, 8, 8));
}

TEST(DimosImage, CompressedPictureHasTheSizeOfItsFile) {
  for (const char* format : {"jpeg", "rgb8; jpeg compressed bgr8"}) {
    const auto image = Decode<images::Image>(Compressed(format)).value;
    EXPECT_EQ(image.bgr.size(), cv::Size(8, 6));
    EXPECT_EQ(image.time.microseconds, 1'700'000'000'123'456);
    EXPECT_NEAR(cv::mean(image.bgr)[2], 200, 3);
  }
}

TEST(HostileDimosImage, WhatDoesNotFitIsRejected) {
  const auto reason = [](void (*change)(sensor_msgs::Image&)) {
    auto message = TwoPixels();
    change(message);
    return ReasonFor<images::Image>(message);
  };
  EXPECT_EQ(reason([](auto&) {}), "accepted");
  EXPECT_EQ(reason([](auto& m) { m.width = 0; }), "bad_image_size");
  EXPECT_EQ(reason([](auto& m) { m.height = -1; }), "bad_image_size");
  EXPECT_EQ(reason([](auto& m) { m.width = m.height = 1 << 30; }), "too_large");
  EXPECT_EQ(reason([](auto& m) { m.step = 5; }), "bad_row_stride");
  EXPECT_EQ(reason([](auto& m) { m.step = -6; }), "bad_row_stride");
  EXPECT_EQ(reason([](auto& m) { m.height = 2; }), "too_few_pixels");
  EXPECT_EQ(reason([](auto& m) { m.encoding = "16UC1"; }), "bad_pixel_format");
  EXPECT_EQ(reason([](auto& m) { m.encoding = ""; }), "bad_pixel_format");
  EXPECT_EQ(reason([](auto& m) { m.encoding = "jpeg"; }), "bad_jpeg");
  EXPECT_EQ(reason([](auto& m) { m.header.stamp.sec = -1; }), "out_of_range");
  EXPECT_EQ(reason([](auto& m) { m.header.stamp.nsec = 1'000'000'000; }), "out_of_range");
  EXPECT_EQ(reason([](auto& m) { m.header.frame_id.assign(2000, 'a'); }), "text_too_long");
}

TEST(HostileDimosImage, PackedColourOfAnOddWidthIsRejected) {
  EXPECT_EQ(ReasonFor<images::Image>(Picture("yuyv", 1, 1, {1, 2})), "bad_image_size");
}

TEST(HostileDimosImage, JpegOfAnotherSizeIsRejected) {
  EXPECT_EQ(ReasonFor<images::Image>(Picture("jpeg", 9, 6, Jpeg())), "jpeg_size");
}

TEST(HostileDimosImage, OtherFilesAreRejected) {
  EXPECT_EQ(ReasonFor<images::Image>(Compressed("png")), "bad_pixel_format");
  CompressedImage message = Compressed("jpeg");
  message.data.resize(message.data.size() - 9);
  message.data_length = static_cast<std::int32_t>(message.data.size());
  EXPECT_EQ(ReasonFor<images::Image>(message), "jpeg_truncated");
  message.data.clear();
  message.data_length = 0;
  EXPECT_EQ(ReasonFor<images::Image>(message), "bad_jpeg");
}

TEST(HostileDimosImage, EveryTruncationIsRejected) {
  const auto whole = Encoded(TwoPixels());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THROW(Codec<images::Image>::Decode({whole.data(), size}), Rejected) << size;
  }
}

TEST(DimosDepth, MillimetresInEitherOrderOfBytes) {
  EXPECT_THAT(DepthOf(Picture("16UC1", 2, 1, {0x39, 0x05, 0xff, 0xff})), ElementsAre(1337, 65535));
  auto big = Picture("mono16", 2, 1, {0x05, 0x39, 0x00, 0x01});
  big.is_bigendian = 1;
  EXPECT_THAT(DepthOf(big), ElementsAre(1337, 1));
}

TEST(DimosDepth, MetresBecomeMillimetresAndWhatIsNoneBecomesZero) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::vector<float> depth_m = {1.2344F, 1.2346F,       65.535F,   65.6F,      0.0F,
                                      -1.0F,   std::nanf(""), kInfinity, -kInfinity, 1e30F};
  EXPECT_THAT(DepthOf(Picture("32FC1", 10, 1, BytesOf(depth_m))),
              ElementsAre(1234, 1235, 65535, 0, 0, 0, 0, 0, 0, 0));
}

TEST(DimosDepth, MetresWithTheHighByteFirst) {
  auto message = Picture("32FC1", 1, 1, {0x3f, 0xc0, 0x00, 0x00});  // 1.5
  message.is_bigendian = 1;
  EXPECT_THAT(DepthOf(message), ElementsAre(1500));
}

TEST(DimosDepth, RowsNeedNotLieWhereAFloatMay) {
  EXPECT_THAT(DepthOf(Picture("32FC1", 1, 2, {0, 0, 0xc0, 0x3f, 7, 0, 0, 0, 0x40, 7})),
              ElementsAre(1500, 2000));
}

TEST(DimosDepth, GoesThereAndBack) {
  const images::DepthImage sent{
      {1'700'000'000'123'456}, "depth", (cv::Mat_<std::uint16_t>(2, 2) << 0, 1, 1337, 65535)};
  const auto bytes = Codec<images::DepthImage>::Encode(sent, 7);
  const auto read = Codec<images::DepthImage>::Decode({bytes.data(), bytes.size()});
  EXPECT_EQ(read.value.time, sent.time);
  EXPECT_EQ(read.value.camera, "depth");
  EXPECT_EQ(read.sequence, -1);
  EXPECT_EQ(cv::norm(read.value.depth_mm, sent.depth_mm, cv::NORM_INF), 0.0);
}

TEST(HostileDimosDepth, ColourIsNoDepth) {
  EXPECT_EQ(ReasonFor<images::DepthImage>(TwoPixels()), "bad_pixel_format");
}

TEST(HostileDimosDepth, TooFewPixelsAreRejected) {
  EXPECT_EQ(ReasonFor<images::DepthImage>(Picture("32FC1", 1, 1, {0, 0, 0})), "bad_row_stride");
}

TEST(DimosLens, IsReadWithItsDistortion) {
  const auto decoded = Decode<CameraCalibration>(Lens());
  const CameraCalibration& lens = decoded.value;
  EXPECT_EQ(decoded.sequence, -1);
  EXPECT_EQ(lens.time.microseconds, 1'700'000'000'123'456);
  EXPECT_EQ(lens.camera, "camera_optical");
  EXPECT_EQ(cv::Size(lens.width_px, lens.height_px), cv::Size(640, 480));
  EXPECT_EQ(lens.focal_px, Eigen::Vector2d(500, 510));
  EXPECT_EQ(lens.principal_point_px, Eigen::Vector2d(320, 240));
  EXPECT_EQ(lens.distortion_model, DistortionModel::kPlumbBob);
  EXPECT_THAT(lens.distortion, ElementsAre(0.1, -0.2, 0.001, 0.002, 0.03));
  EXPECT_TRUE(lens.rectification.isIdentity(0.0));
  EXPECT_TRUE(lens.is_calibrated);
  EXPECT_FALSE(lens.parent_from_camera);
}

TEST(DimosLens, EveryModelIsKnownByItsName) {
  const auto model = [](const std::string& name, int n_coefficients) {
    CameraInfo message = Lens();
    message.distortion_model = name;
    message.D.assign(static_cast<std::size_t>(n_coefficients), 0.01);
    message.D_length = n_coefficients;
    return Decode<CameraCalibration>(message).value.distortion_model;
  };
  EXPECT_EQ(model("", 0), DistortionModel::kNone);
  EXPECT_EQ(model("plumb_bob", 0), DistortionModel::kNone);
  EXPECT_EQ(model("rational_polynomial", 8), DistortionModel::kRational);
  EXPECT_EQ(model("equidistant", 4), DistortionModel::kFisheye);
}

TEST(DimosLens, RotationThatNobodyHasFilledInIsNone) {
  CameraInfo message = Lens();
  std::fill(std::begin(message.R), std::end(message.R), 0.0);
  EXPECT_TRUE(Decode<CameraCalibration>(message).value.rectification.isIdentity(0.0));
}

TEST(HostileDimosLens, WhatNoLensHasIsRejected) {
  const auto reason = [](void (*change)(CameraInfo&)) {
    CameraInfo message = Lens();
    change(message);
    return ReasonFor<CameraCalibration>(message);
  };
  EXPECT_EQ(reason([](auto&) {}), "accepted");
  EXPECT_EQ(reason([](auto& m) { m.K[0] = 0.0; }), "out_of_range");
  EXPECT_EQ(reason([](auto& m) { m.K[1] = 3.0; }), "out_of_range");
  EXPECT_EQ(reason([](auto& m) { m.K[2] = std::nan(""); }), "not_finite");
  EXPECT_EQ(reason([](auto& m) { m.D[1] = std::nan(""); }), "not_finite");
  EXPECT_EQ(reason([](auto& m) { m.R[0] = 0.5; }), "out_of_range");
  EXPECT_EQ(reason([](auto& m) { m.R[1] = std::nan(""); }), "not_finite");
  EXPECT_EQ(reason([](auto& m) { m.width = 0; }), "out_of_range");
  EXPECT_EQ(reason([](auto& m) { m.distortion_model = "equidistant"; }), "out_of_range");
  EXPECT_EQ(reason([](auto& m) { m.distortion_model = "spherical"; }), "out_of_range");
  EXPECT_EQ(reason([](auto& m) { m.D.assign(15, 0.0), m.D_length = 15; }), "too_many");
  EXPECT_EQ(reason([](auto& m) { m.header.stamp.nsec = -1; }), "out_of_range");
}

TEST(HostileDimosLens, PartOfThePictureIsRejectedUnlessItIsTheWhole) {
  const auto reason = [](void (*change)(CameraInfo&)) {
    CameraInfo message = Lens();
    change(message);
    return ReasonFor<CameraCalibration>(message);
  };
  EXPECT_EQ(reason([](auto& m) { m.binning_x = m.binning_y = 1; }), "accepted");
  EXPECT_EQ(reason([](auto& m) { m.roi.width = 640, m.roi.height = 480; }), "accepted");
  EXPECT_EQ(reason([](auto& m) { m.binning_y = 2; }), "unsupported_binning");
  EXPECT_EQ(reason([](auto& m) { m.roi.x_offset = 8; }), "unsupported_binning");
  EXPECT_EQ(reason([](auto& m) { m.roi.height = 100; }), "unsupported_binning");
}

// A quarter about z, 1 2 3 m away.
TFMessage Transforms() {
  geometry_msgs::TransformStamped neck{};
  neck.header = Header();
  neck.header.frame_id = "base_link";
  neck.child_frame_id = "neck";
  neck.transform.translation.x = 1.0;
  neck.transform.translation.y = 2.0;
  neck.transform.translation.z = 3.0;
  neck.transform.rotation.z = neck.transform.rotation.w = std::sqrt(0.5);
  geometry_msgs::TransformStamped camera = neck;
  camera.header.frame_id = "neck";
  camera.child_frame_id = "camera_optical";
  TFMessage message{};
  message.transforms = {neck, camera};
  message.transforms_length = 2;
  return message;
}

TEST(DimosTransforms, AreReadWithTheirFramesAndTimes) {
  const auto decoded = Decode<FrameTransforms>(Transforms());
  EXPECT_EQ(decoded.sequence, -1);
  ASSERT_EQ(decoded.value.size(), 2U);
  const geometry::FrameTransform& neck = decoded.value[0];
  EXPECT_EQ(neck.time.microseconds, 1'700'000'000'123'456);
  EXPECT_EQ(neck.parent, "base_link");
  EXPECT_EQ(neck.child, "neck");
  EXPECT_TRUE(
      (neck.parent_from_child * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(1, 3, 3)));
}

TEST(DimosTransforms, GoThereAndBack) {
  const auto sent = Decode<FrameTransforms>(Transforms()).value;
  const auto bytes = Codec<FrameTransforms>::Encode(sent, 7);
  const auto read = Codec<FrameTransforms>::Decode({bytes.data(), bytes.size()}).value;
  ASSERT_EQ(read.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) {
    EXPECT_EQ(read[i].time, sent[i].time);
    EXPECT_EQ(read[i].parent, sent[i].parent);
    EXPECT_EQ(read[i].child, sent[i].child);
    EXPECT_TRUE(read[i].parent_from_child.rotation.isApprox(sent[i].parent_from_child.rotation));
    EXPECT_EQ(read[i].parent_from_child.translation_m, sent[i].parent_from_child.translation_m);
  }
}

TEST(HostileDimosTransforms, WhatNoTransformHasIsRejected) {
  const auto reason = [](void (*change)(TFMessage&)) {
    TFMessage message = Transforms();
    change(message);
    return ReasonFor<FrameTransforms>(message);
  };
  EXPECT_EQ(reason([](auto&) {}), "accepted");
  EXPECT_EQ(reason([](auto& m) { m.transforms[1].child_frame_id = ""; }), "out_of_range");
  EXPECT_EQ(reason([](auto& m) { m.transforms[1].header.frame_id = ""; }), "out_of_range");
  EXPECT_EQ(reason([](auto& m) { m.transforms[0].child_frame_id = "base_link"; }), "out_of_range");
  EXPECT_EQ(reason([](auto& m) { m.transforms[0].child_frame_id.assign(2000, 'a'); }),
            "text_too_long");
  EXPECT_EQ(reason([](auto& m) { m.transforms[0].transform.rotation.w = 0.0; }), "not_a_rotation");
  EXPECT_EQ(reason([](auto& m) { m.transforms[0].transform.rotation.x = std::nan(""); }),
            "not_finite");
  EXPECT_EQ(reason([](auto& m) { m.transforms[0].transform.translation.z = 1e300; }),
            "out_of_range");
  EXPECT_EQ(reason([](auto& m) { m.transforms[0].transform.translation.x = std::nan(""); }),
            "not_finite");
  EXPECT_EQ(reason([](auto& m) { m.transforms[0].header.stamp.sec = -1; }), "out_of_range");
  EXPECT_EQ(reason([](auto& m) {
              m.transforms.resize(1025, m.transforms[0]);
              m.transforms_length = 1025;
            }),
            "too_many");
}

TEST(HostileDimosTransforms, EveryTruncationIsRejected) {
  const auto whole = Encoded(Transforms());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THROW(Codec<FrameTransforms>::Decode({whole.data(), size}), Rejected) << size;
  }
}

}  // namespace
}  // namespace deixis::messages
