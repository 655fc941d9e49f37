#include "services/stereo_driver/core/calibration/rig_calibration.h"

#include <gmock/gmock.h>

#include "test/services/stereo_driver/synthetic_rig.h"
#include "test/support/temporary_folder.h"

namespace deixis::stereo_driver {
namespace {

using config::ConfigError;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class RigCalibrationTest : public testing::Test {
 protected:
  RigCalibrationConfig Written(const std::string& intrinsics, const std::string& extrinsics) {
    RigCalibrationConfig config;
    config.intrinsics = folder_.Write("intrinsics.yml", intrinsics).string();
    config.extrinsics = folder_.Write("extrinsics.yml", extrinsics).string();
    return config;
  }
  RigCalibrationConfig Written(const geometry::StereoCalibration& rig, double unit_m = 1.0) {
    return Written(IntrinsicsText(rig), ExtrinsicsText(rig, unit_m));
  }
  auto Reading(const RigCalibrationConfig& config) {
    return [config] { RigCalibration calibration(config); };
  }
  test::TemporaryFolder folder_;
  const geometry::StereoCalibration rig_ = SyntheticRig();
};

TEST_F(RigCalibrationTest, ReadsWhatStereoCalibWrites) {
  const auto [calibration, remark] = RigCalibration(Written(rig_)).For({320, 240});
  EXPECT_THAT(remark, HasSubstr("no image size"));
  EXPECT_TRUE(calibration.left.focal_px.isApprox(rig_.left.focal_px));
  EXPECT_TRUE(calibration.right.principal_point_px.isApprox(rig_.right.principal_point_px));
  EXPECT_EQ(calibration.right.distortion, rig_.right.distortion);
  EXPECT_TRUE(
      calibration.right_from_left.translation_m.isApprox(rig_.right_from_left.translation_m));
  EXPECT_TRUE(calibration.right_from_left.rotation.isApprox(rig_.right_from_left.rotation, 1e-9));
  EXPECT_EQ(calibration.rectified.width_px, 320);
  EXPECT_TRUE(calibration.rectified.is_calibrated);
}

TEST_F(RigCalibrationTest, RectificationPutsAPointIntoOneRow) {
  const auto calibration = RigCalibration(Written(rig_)).For({320, 240}).calibration;
  const Eigen::Vector3d point(0.4, -0.3, 2.0);
  const Eigen::Vector3d in_left = calibration.left.rectification * point;
  const Eigen::Vector3d in_right =
      calibration.right.rectification * (calibration.right_from_left * point);
  const double baseline_m = calibration.right_from_left.translation_m.norm();
  EXPECT_NEAR((in_left - in_right - Eigen::Vector3d(baseline_m, 0, 0)).norm(), 0.0, 1e-9);
}

TEST_F(RigCalibrationTest, CountsInBoardSquaresWhenTold) {
  RigCalibrationConfig config = Written(rig_, 0.03);
  EXPECT_THAT(Reading(config),
              ThrowsMessage<ConfigError>(AllOf(HasSubstr("extrinsics.yml"), HasSubstr("T "),
                                               HasSubstr("calibration.unit_m"))));
  config.unit_m = 0.03;
  const auto calibration = RigCalibration(config).For({320, 240}).calibration;
  EXPECT_NEAR(calibration.right_from_left.translation_m.x(), -0.12, 1e-9);
}

TEST_F(RigCalibrationTest, SaysHowLongAnAbsurdBaselineIs) {
  RigCalibrationConfig config = Written(rig_);
  config.unit_m = 1e18;
  EXPECT_THAT(Reading(config), ThrowsMessage<ConfigError>(HasSubstr("baseline of 1.2")));
  config.unit_m = 1e308;
  EXPECT_THAT(Reading(config), ThrowsMessage<ConfigError>(HasSubstr("baseline of inf mm")));
}

TEST_F(RigCalibrationTest, RefusesHalfASizeInEitherFile) {
  EXPECT_THAT(Reading(Written(IntrinsicsText(rig_) + "image_height: 240\n", ExtrinsicsText(rig_))),
              ThrowsMessage<ConfigError>(
                  AllOf(HasSubstr("intrinsics.yml"), HasSubstr("'image_width' is missing"))));
}

TEST_F(RigCalibrationTest, ScalesToPicturesOfTheSameAspect) {
  RigCalibrationConfig config = Written(rig_);
  config.width_px = 320;
  config.height_px = 240;
  const RigCalibration rig(config);
  const auto [calibration, remark] = rig.For({640, 480});
  EXPECT_THAT(remark, HasSubstr("scaled from 320x240"));
  EXPECT_NEAR(calibration.left.focal_px.x(), 560.0, 1e-9);
  // The shared view is searched on a grid of pixels: not exact.
  EXPECT_NEAR(
      calibration.rectified.focal_px.x() / rig.For({320, 240}).calibration.rectified.focal_px.x(),
      2.0, 0.02);
  EXPECT_THAT(
      [&] {
        rig.For({640, 360});
      },
      ThrowsMessage<ConfigError>(AllOf(HasSubstr("320x240"), HasSubstr("640x360"))));
}

TEST_F(RigCalibrationTest, TakesTheSizeThatAFileStates) {
  const std::string sized = ExtrinsicsText(rig_) + "image_width: 320\nimage_height: 240\n";
  const RigCalibration rig(Written(IntrinsicsText(rig_), sized));
  EXPECT_EQ(rig.For({320, 240}).remark, "");
  EXPECT_THAT(rig.For({160, 120}).remark, HasSubstr("scaled"));
}

TEST_F(RigCalibrationTest, TakesTheRectificationOfTheFileWhenTold) {
  RigCalibrationConfig config = Written(rig_);
  const auto computed = RigCalibration(config).For({320, 240}).calibration;
  config.rectification = Rectification::kFromFile;
  const auto filed = RigCalibration(config).For({320, 240}).calibration;
  EXPECT_TRUE(filed.left.rectification.isApprox(computed.left.rectification, 1e-9));
  // The file was written with alpha 1: it shows all, smaller.
  EXPECT_LT(filed.rectified.focal_px.x(), computed.rectified.focal_px.x());
}

TEST_F(RigCalibrationTest, RefusesAFiledProjectionThatNoReceiverTakes) {
  const auto projections = [](const std::string& row) {
    std::string text;
    for (const std::string name : {"P1", "P2"}) {
      text += name + ": !!opencv-matrix\n   rows: 3\n   cols: 4\n   dt: d\n   data: [ " + row +
              (name == "P1" ? ", 0." : ", -33.6") + ", 0., 280., 119.5, 0., 0., 0., 1., 0. ]\n";
    }
    return text;
  };
  const std::string all = ExtrinsicsText(rig_);
  RigCalibrationConfig config = Written(
      IntrinsicsText(rig_), all.substr(0, all.find("P1:")) + projections("280., 0., 1e300"));
  config.rectification = Rectification::kFromFile;
  EXPECT_THAT(Reading(config),
              ThrowsMessage<ConfigError>(
                  AllOf(HasSubstr("extrinsics.yml: P1"), HasSubstr("principal point 1e+300"))));
}

TEST_F(RigCalibrationTest, RefusesSwappedCameras) {
  geometry::StereoCalibration swapped = rig_;
  std::swap(swapped.left, swapped.right);
  swapped.right_from_left = geometry::Inverse(rig_.right_from_left);
  EXPECT_THAT(Reading(Written(swapped)),
              ThrowsMessage<ConfigError>(AllOf(HasSubstr("extrinsics.yml"), HasSubstr("swap"))));
}

TEST_F(RigCalibrationTest, RefusesCamerasAboveEachOther) {
  geometry::StereoCalibration vertical = rig_;
  vertical.right_from_left.translation_m = {0.001, -0.12, 0.0};
  EXPECT_THAT(
      Reading(Written(vertical)),
      ThrowsMessage<ConfigError>(AllOf(HasSubstr("extrinsics.yml"), HasSubstr("side by side"))));
}

TEST_F(RigCalibrationTest, RefusesWhatIsNoRotation) {
  std::string text = "%YAML:1.0\n---\nR: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n";
  text += "   data: [ 2., 0., 0., 0., 2., 0., 0., 0., 2. ]\n";
  EXPECT_THAT(Reading(Written(IntrinsicsText(rig_), text)),
              ThrowsMessage<ConfigError>(
                  AllOf(HasSubstr("extrinsics.yml"), HasSubstr("R is not a rotation"))));
}

TEST_F(RigCalibrationTest, NamesFileAndKeyThatIsMissing) {
  EXPECT_THAT(Reading(Written(ExtrinsicsText(rig_), ExtrinsicsText(rig_))),
              ThrowsMessage<ConfigError>(AllOf(HasSubstr("intrinsics.yml"), HasSubstr("M1"))));
  EXPECT_THAT(Reading(Written(IntrinsicsText(rig_), IntrinsicsText(rig_))),
              ThrowsMessage<ConfigError>(AllOf(HasSubstr("extrinsics.yml"), HasSubstr("'R'"))));
}

TEST_F(RigCalibrationTest, NamesTheFileThatIsNotThere) {
  RigCalibrationConfig config = Written(rig_);
  config.extrinsics = (folder_.path() / "nowhere.yml").string();
  EXPECT_THAT(Reading(config), ThrowsMessage<ConfigError>(HasSubstr("nowhere.yml")));
}

TEST(RigCalibrationConfig, NamesWhatIsOutOfRange) {
  RigCalibrationConfig config;
  config.unit_m = 0.0;
  config.alpha = 2.0;
  EXPECT_THAT([&] { config.Validate(); },
              ThrowsMessage<ConfigError>(AllOf(HasSubstr("unit_m"), HasSubstr("alpha"))));
}

}  // namespace
}  // namespace deixis::stereo_driver
