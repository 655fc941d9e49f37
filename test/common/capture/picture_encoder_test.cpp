#include "common/capture/picture_encoder.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "common/images/jpeg_check.h"
#include "test/common/capture/scripted_source.h"

namespace deixis::capture {
namespace {

Picture JpegPicture() {
  Picture picture = PictureAt(0);
  cv::imencode(".jpg", picture.bgr, picture.jpeg, {cv::IMWRITE_JPEG_QUALITY, 31});
  return picture;
}

TEST(PictureEncoder, WritesAJpegOfThePictureWithItsTimeAndCamera) {
  const images::EncodedImage image = Encode(PictureAt(0), {77}, "CAMERA", {});
  EXPECT_EQ(image.time.microseconds, 77);
  EXPECT_EQ(image.camera, "CAMERA");
  EXPECT_EQ(image.width_px, 64);
  EXPECT_EQ(image.height_px, 48);
  const cv::Mat bgr = cv::imdecode(image.jpeg, cv::IMREAD_COLOR);
  ASSERT_EQ(bgr.size(), cv::Size(64, 48));
  EXPECT_NEAR(bgr.at<cv::Vec3b>(20, 20)[2], 160, 3);
}

TEST(PictureEncoder, HandsAJpegFileOnAsItIs) {
  const Picture picture = JpegPicture();
  EXPECT_EQ(Encode(picture, {0}, "CAMERA", {}).jpeg, picture.jpeg);
}

TEST(PictureEncoder, EncodesAnewWhatReceiversRefuse) {
  Picture picture = PictureAt(0);
  cv::imencode(".jpg", picture.bgr, picture.jpeg, {cv::IMWRITE_JPEG_PROGRESSIVE, 1});
  for (const auto& refused : {picture.jpeg, std::vector<std::uint8_t>{0xFF, 0xD8}}) {
    picture.jpeg = refused;
    const auto jpeg = Encode(picture, {0}, "CAMERA", {}).jpeg;
    EXPECT_EQ(images::CheckJpeg(jpeg.data(), jpeg.size(), 64, 48), images::JpegFault::kNone);
  }
}

TEST(PictureEncoder, MakesWidePicturesSmaller) {
  EncodingConfig config;
  config.max_width_px = 32;
  const images::EncodedImage image = Encode(JpegPicture(), {0}, "CAMERA", config);
  EXPECT_EQ(image.width_px, 32);
  EXPECT_EQ(image.height_px, 24);
  EXPECT_EQ(cv::imdecode(image.jpeg, cv::IMREAD_COLOR).size(), cv::Size(32, 24));
}

TEST(PictureEncoder, TurnsAFileThatMayAskToBeTurned) {
  Picture picture = JpegPicture();
  const std::vector<std::uint8_t> exif{0xFF, 0xE1, 0, 10, 'E', 'x', 'i', 'f', 0, 0, 0, 0};
  picture.jpeg.insert(picture.jpeg.begin() + 2, exif.begin(), exif.end());
  EXPECT_NE(Encode(picture, {0}, "CAMERA", {}).jpeg, picture.jpeg);
}

TEST(PictureEncoder, RefusesQualitiesThatJpegDoesNotHave) {
  EncodingConfig config;
  config.jpeg_quality = 0;
  config::Faults faults;
  config.Check(faults);
  EXPECT_THROW(faults.ThrowIfAny(), config::ConfigError);
}

}  // namespace
}  // namespace deixis::capture
