#include "services/stereo_driver/core/calibration/registration_calibration.h"

#include <gmock/gmock.h>

#include "test/services/stereo_driver/synthetic_depth.h"
#include "test/support/temporary_folder.h"

namespace deixis::stereo_driver {
namespace {

using config::ConfigError;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const cv::Size kSize(320, 240);

class RegistrationCalibrationTest : public testing::Test {
 protected:
  RegistrationCalibrationTest() {
    config_.mode = RegistrationMode::kExtrinsics;
    config_.intrinsics = Write("intrinsics.yml", ColourAndDepthIntrinsics() + kSizes);
    config_.extrinsics = Write("extrinsics.yml", ColourAndDepthExtrinsics());
  }
  std::string Write(const std::string& name, const std::string& text) {
    return folder_.Write(name, text).string();
  }
  auto Reading() {
    return [this] { RegistrationCalibration calibration(config_); };
  }

  const std::string kSizes = "image_width: 320\nimage_height: 240\n";
  test::TemporaryFolder folder_;
  RegistrationConfig config_;
  const DepthView truth_ = DepthBesideColour();
};

TEST_F(RegistrationCalibrationTest, ReadsWhatTheCalibratorWritesWithColourFirst) {
  const RegistrationCalibration calibration(config_);
  const auto [view, remark] = calibration.For(kSize);
  EXPECT_EQ(remark, "");
  EXPECT_TRUE(view.lens.focal_px.isApprox(truth_.lens.focal_px));
  EXPECT_EQ(view.lens.distortion, truth_.lens.distortion);
  EXPECT_TRUE(
      view.colour_from_depth.translation_m.isApprox(truth_.colour_from_depth.translation_m));
  EXPECT_TRUE(view.colour_from_depth.rotation.isApprox(truth_.colour_from_depth.rotation, 1e-9));
  ASSERT_TRUE(calibration.colour_lens());
  EXPECT_TRUE(calibration.colour_lens()->calibration.focal_px.isApprox(ColourLens().focal_px));
}

TEST_F(RegistrationCalibrationTest, ReadsItWithDepthFirst) {
  config_.first = FirstCamera::kDepth;
  const RegistrationCalibration calibration(config_);
  const DepthView view = calibration.For(kSize).view;
  EXPECT_TRUE(view.lens.focal_px.isApprox(ColourLens().focal_px));
  const auto depth_from_colour = geometry::Inverse(truth_.colour_from_depth);
  EXPECT_TRUE(view.colour_from_depth.translation_m.isApprox(depth_from_colour.translation_m));
  EXPECT_TRUE(calibration.colour_lens()->calibration.focal_px.isApprox(truth_.lens.focal_px));
}

TEST_F(RegistrationCalibrationTest, ReadsTheDepthLensAloneWhenPicturesDifferInSize) {
  config_.intrinsics.clear();
  // M1 is as good a lens as camera_matrix.
  config_.depth_lens = Write("depth.yml", ColourAndDepthIntrinsics());
  const RegistrationCalibration calibration(config_);
  EXPECT_FALSE(calibration.colour_lens());
  EXPECT_THAT(calibration.For(kSize).remark, AllOf(HasSubstr("depth lens"), HasSubstr("no image")));
}

TEST_F(RegistrationCalibrationTest, ScalesTheDepthLens) {
  const auto [view, remark] = RegistrationCalibration(config_).For({640, 480});
  EXPECT_NEAR(view.lens.focal_px.x(), 610.0, 1e-9);
  EXPECT_THAT(remark, HasSubstr("depth lens: calibration scaled from 320x240"));
}

TEST_F(RegistrationCalibrationTest, NamesTheCureForDepthOfAnotherAspect) {
  const RegistrationCalibration calibration(config_);
  EXPECT_THAT(
      [&] {
        calibration.For({512, 424});
      },
      ThrowsMessage<ConfigError>(AllOf(HasSubstr("intrinsics.yml"), HasSubstr("320x240"),
                                       HasSubstr("512x424"),
                                       HasSubstr("registration.depth_lens"))));
}

TEST_F(RegistrationCalibrationTest, TakesCamerasOnOneAxis) {
  config_.extrinsics = Write("same.yml",
                             "%YAML:1.0\n---\n"
                             "R: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
                             "   data: [ 1., 0., 0., 0., 1., 0., 0., 0., 1. ]\n"
                             "T: !!opencv-matrix\n   rows: 3\n   cols: 1\n   dt: d\n"
                             "   data: [ 0., 0., 0. ]\n");
  const DepthView view = RegistrationCalibration(config_).For(kSize).view;
  EXPECT_EQ(view.colour_from_depth.translation_m, Eigen::Vector3d::Zero());
}

TEST_F(RegistrationCalibrationTest, CountsInUnitsWhenTold) {
  config_.extrinsics = Write("extrinsics.yml", ColourAndDepthExtrinsics(0.001));
  EXPECT_THAT(Reading(),
              ThrowsMessage<ConfigError>(AllOf(HasSubstr("extrinsics.yml"), HasSubstr("T makes"),
                                               HasSubstr("depth_camera.registration.unit_m"))));
  config_.unit_m = 0.001;
  const DepthView view = RegistrationCalibration(config_).For(kSize).view;
  EXPECT_NEAR(view.colour_from_depth.translation_m.x(), 0.025, 1e-9);
}

TEST_F(RegistrationCalibrationTest, NamesFileKeyAndCureOfWhatIsMissing) {
  config_.intrinsics = config_.extrinsics;
  EXPECT_THAT(Reading(),
              ThrowsMessage<ConfigError>(AllOf(HasSubstr("extrinsics.yml"), HasSubstr("M1"))));
  config_.intrinsics = (folder_.path() / "nowhere.yml").string();
  EXPECT_THAT(Reading(),
              ThrowsMessage<ConfigError>(AllOf(HasSubstr("nowhere.yml"),
                                               HasSubstr("depth_camera.registration.intrinsics"))));
  config_.intrinsics.clear();
  config_.depth_lens = (folder_.path() / "nowhere.yml").string();
  EXPECT_THAT(Reading(),
              ThrowsMessage<ConfigError>(AllOf(HasSubstr("nowhere.yml"),
                                               HasSubstr("depth_camera.registration.depth_lens"))));
}

TEST(RegistrationConfig, WantsNothingOfTheSensorsOwnRegistration) {
  EXPECT_NO_THROW(RegistrationConfig().Validate());
}

TEST(RegistrationConfig, NamesWhatExtrinsicsNeed) {
  RegistrationConfig config;
  config.mode = RegistrationMode::kExtrinsics;
  EXPECT_THAT([&] { config.Validate(); },
              ThrowsMessage<ConfigError>(AllOf(HasSubstr("extrinsics"), HasSubstr("intrinsics"),
                                               HasSubstr("calibrate stereo"))));
  config.extrinsics = "extrinsics.yml";
  config.intrinsics = "intrinsics.yml";
  EXPECT_NO_THROW(config.Validate());
  config.depth_lens = "depth.yml";
  EXPECT_THAT([&] { config.Validate(); }, ThrowsMessage<ConfigError>(HasSubstr("one of the two")));
  config.unit_m = 0.0;
  EXPECT_THAT([&] { config.Validate(); }, ThrowsMessage<ConfigError>(HasSubstr("unit_m")));
}

TEST(RegistrationFault, SaysWhatIsWrongAndItsCure) {
  EXPECT_EQ(RegistrationFault(RegistrationMode::kSensor, true), "");
  EXPECT_EQ(RegistrationFault(RegistrationMode::kExtrinsics, false), "");
  EXPECT_THAT(RegistrationFault(RegistrationMode::kSensor, false),
              AllOf(HasSubstr("not registered"), HasSubstr("mode to extrinsics")));
  EXPECT_THAT(RegistrationFault(RegistrationMode::kExtrinsics, true),
              AllOf(HasSubstr("once more"), HasSubstr("mode to sensor")));
}

}  // namespace
}  // namespace deixis::stereo_driver
