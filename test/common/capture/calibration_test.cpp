#include "common/capture/calibration.h"

#include <gmock/gmock.h>

#include "test/support/temporary_folder.h"

namespace deixis::capture {
namespace {

using geometry::DistortionModel;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string Matrix(const std::string& name, int rows, int cols, const std::string& data) {
  return name + ": !!opencv-matrix\n   rows: " + std::to_string(rows) +
         "\n   cols: " + std::to_string(cols) + "\n   dt: d\n   data: [ " + data + " ]\n";
}

const std::string kHeader = "%YAML:1.0\n---\n";
const std::string kSize = "image_width: 640\nimage_height: 480\n";
const std::string kPinhole = "500., 0., 319.5, 0., 510., 239.5, 0., 0., 1.";
const std::string kFive = "-0.1, 0.02, 0.001, 0.002, 0.";

std::string CalibrationSample() {
  return kHeader + kSize + Matrix("camera_matrix", 3, 3, kPinhole) +
         Matrix("distortion_coefficients", 5, 1, kFive);
}

class CalibrationTest : public testing::Test {
 protected:
  Calibration From(const std::string& text) {
    CalibrationConfig config;
    config.file = folder_.Write("lens.yaml", text).string();
    return Calibration(config);
  }
  auto Reading(const std::string& text) {
    return [this, text] { From(text); };
  }
  test::TemporaryFolder folder_;
};

TEST_F(CalibrationTest, ReadsWhatTheCalibrationSampleWrites) {
  const auto [lens, remark] = From(CalibrationSample()).For({640, 480});
  EXPECT_TRUE(lens.is_calibrated);
  EXPECT_EQ(lens.focal_px, Eigen::Vector2d(500, 510));
  EXPECT_EQ(lens.principal_point_px, Eigen::Vector2d(319.5, 239.5));
  EXPECT_EQ(lens.distortion_model, DistortionModel::kPlumbBob);
  EXPECT_THAT(lens.distortion, ElementsAre(-0.1, 0.02, 0.001, 0.002, 0.0));
  EXPECT_EQ(remark, "");
}

TEST_F(CalibrationTest, ReadsTheLeftCameraOfStereoCalib) {
  const auto [lens, remark] =
      From(kHeader + Matrix("M1", 3, 3, kPinhole) + Matrix("D1", 1, 5, kFive)).For({640, 480});
  EXPECT_EQ(lens.focal_px, Eigen::Vector2d(500, 510));
  EXPECT_EQ(lens.width_px, 640);
  EXPECT_THAT(remark, HasSubstr("no image size"));
}

TEST_F(CalibrationTest, KnowsRationalAndFisheyeLenses) {
  const std::string start = kHeader + kSize + Matrix("camera_matrix", 3, 3, kPinhole);
  const auto rational =
      From(start + Matrix("distortion_coefficients", 1, 8, "1., 2., 3., 4., 5., 6., 7., 8."));
  EXPECT_EQ(rational.For({640, 480}).calibration.distortion_model, DistortionModel::kRational);
  const auto fisheye = From(start + "fisheye_model: 1\n" +
                            Matrix("distortion_coefficients", 4, 1, "0.1, 0.2, 0.3, 0.4"));
  EXPECT_EQ(fisheye.For({640, 480}).calibration.distortion_model, DistortionModel::kFisheye);
}

TEST_F(CalibrationTest, ScalesToAnotherSizeOfTheSameAspectAndSaysSo) {
  const auto [lens, remark] = From(CalibrationSample()).For({320, 240});
  EXPECT_EQ(lens.focal_px, Eigen::Vector2d(250, 255));
  // The picture's middle stays the middle: pixel centres lie at whole numbers.
  EXPECT_EQ(lens.principal_point_px, Eigen::Vector2d(159.5, 119.5));
  EXPECT_EQ(lens.width_px, 320);
  EXPECT_TRUE(lens.is_calibrated);
  EXPECT_THAT(remark, HasSubstr("scaled from 640x480"));
}

TEST_F(CalibrationTest, RefusesPicturesOfAnotherAspect) {
  const Calibration calibration = From(CalibrationSample());
  EXPECT_THAT(
      [&] {
        calibration.For({1280, 720});
      },
      ThrowsMessage<config::ConfigError>(
          AllOf(HasSubstr("lens.yaml"), HasSubstr("640x480"), HasSubstr("1280x720"))));
}

TEST_F(CalibrationTest, GuessesWithoutAFileAndSaysSo) {
  CalibrationConfig config;
  config.horizontal_fov_deg = 90.0;
  const auto [lens, remark] = Calibration(config).For({640, 480});
  EXPECT_FALSE(lens.is_calibrated);
  EXPECT_NEAR(lens.focal_px.x(), 320.0, 1e-9);
  EXPECT_THAT(remark, AllOf(HasSubstr("guessed"), HasSubstr("90 deg; set calibration.file")));
}

TEST_F(CalibrationTest, NamesTheKeyUnderWhichItStands) {
  CalibrationConfig config;
  config.key = "depth_camera.calibration";
  EXPECT_THAT(Calibration(config).For({640, 480}).remark,
              HasSubstr("; set depth_camera.calibration.file"));
  config.file = "missing.yaml";
  EXPECT_THAT([&config] { Calibration calibration(config); },
              ThrowsMessage<config::ConfigError>(
                  HasSubstr("; set depth_camera.calibration.file, or leave it empty to guess")));
}

TEST_F(CalibrationTest, NamesFileAndKeyThatIsMissing) {
  EXPECT_THAT(Reading(kHeader + kSize + Matrix("camera_matrix", 3, 3, kPinhole)),
              ThrowsMessage<config::ConfigError>(
                  AllOf(HasSubstr("lens.yaml"), HasSubstr("distortion_coefficients"))));
  EXPECT_THAT(Reading(kHeader + kSize),
              ThrowsMessage<config::ConfigError>(HasSubstr("camera_matrix")));
}

TEST_F(CalibrationTest, RefusesMatricesOfTheWrongSize) {
  EXPECT_THAT(Reading(kHeader + Matrix("M1", 2, 3, "1., 0., 1., 0., 1., 1.")),
              ThrowsMessage<config::ConfigError>(HasSubstr("must be 3x3 but is 2x3")));
  EXPECT_THAT(Reading(kHeader + Matrix("M1", 3, 3, kPinhole) + Matrix("D1", 1, 2, "1., 2.")),
              ThrowsMessage<config::ConfigError>(HasSubstr("4, 5 or 8 values")));
  EXPECT_THAT(Reading(kHeader + Matrix("M1", 3, 3, kPinhole) +
                      Matrix("D1", 1, 6, "0.1, 0., 0., 0., 0., 0.2")),
              ThrowsMessage<config::ConfigError>(HasSubstr("4, 5 or 8 values")));
}

TEST_F(CalibrationTest, RefusesLensesThatNoReceiverTakes) {
  for (const std::string number : {"1e39", "1e300", "1e308", "1e-308", "0.", "-500."}) {
    EXPECT_THAT(
        Reading(kHeader + Matrix("M1", 3, 3, number + ", 0., 319.5, 0., 510., 239.5, 0., 0., 1.") +
                Matrix("D1", 1, 5, kFive)),
        ThrowsMessage<config::ConfigError>(AllOf(HasSubstr("lens.yaml: "), HasSubstr("M1"),
                                                 HasSubstr("focal"), HasSubstr("calibrate again"))))
        << number;
  }
  EXPECT_THAT(Reading(kHeader + Matrix("M1", 3, 3, "500., 0., 1e300, 0., 510., 239.5, 0., 0., 1.") +
                      Matrix("D1", 1, 5, kFive)),
              ThrowsMessage<config::ConfigError>(HasSubstr("principal point 1e+300")));
  EXPECT_THAT(
      Reading(kHeader + Matrix("M1", 3, 3, kPinhole) + Matrix("D1", 1, 5, "1e308, 0., 0., 0., 0.")),
      ThrowsMessage<config::ConfigError>(AllOf(HasSubstr("D1"), HasSubstr("coefficient"))));
}

TEST_F(CalibrationTest, RefusesALensThatScalingMakesNone) {
  const Calibration calibration =
      From(kHeader + kSize + Matrix("M1", 3, 3, "1., 0., 319.5, 0., 510., 239.5, 0., 0., 1.") +
           Matrix("D1", 1, 5, kFive));
  EXPECT_THAT(
      [&] {
        calibration.For({320, 240});
      },
      ThrowsMessage<config::ConfigError>(AllOf(HasSubstr("lens.yaml"), HasSubstr("320x240"))));
}

TEST_F(CalibrationTest, GuessesWhereScalingMakesTheCamerasOwnLensNone) {
  Calibration calibration{CalibrationConfig{}};
  geometry::CameraCalibration own = geometry::GuessCalibration(640, 480, 1.0);
  own.focal_px.x() = 1.0;
  calibration.UseOwn(own);
  EXPECT_THAT(calibration.For({320, 240}).remark, HasSubstr("guessed"));
}

TEST_F(CalibrationTest, RefusesWhatIsNoMatrix) {
  EXPECT_THAT(Reading(kHeader + "camera_matrix: 5\n" + Matrix("D1", 1, 5, kFive)),
              ThrowsMessage<config::ConfigError>(HasSubstr("not an opencv-matrix")));
}

TEST_F(CalibrationTest, RefusesAFileThatOpenCvCannotRead) {
  EXPECT_THAT(Reading("neither YAML nor: [ anything"),
              ThrowsMessage<config::ConfigError>(HasSubstr("lens.yaml")));
}

TEST_F(CalibrationTest, SaysThatAFileCannotBeRead) {
  EXPECT_THAT([] { ReadLensFile("/proc/self/mem"); },
              ThrowsMessage<config::ConfigError>(HasSubstr("cannot be read: ")));
  EXPECT_THAT([] { ReadLensFile(std::string(300, 'x')); },
              ThrowsMessage<config::ConfigError>(HasSubstr("does not exist")));
}

TEST_F(CalibrationTest, RefusesAFileThatIsNotThere) {
  CalibrationConfig config;
  config.file = (folder_.path() / "missing.yaml").string();
  EXPECT_THAT([&config] { Calibration calibration(config); },
              ThrowsMessage<config::ConfigError>(HasSubstr("missing.yaml")));
}

TEST(ShippedCamera, ExampleIsRead) {
  CalibrationConfig config;
  config.file = DEIXIS_SOURCE_DIR "/config/cameras/example.yaml";
  EXPECT_EQ(Calibration(config).For({640, 480}).remark, "");
}

}  // namespace
}  // namespace deixis::capture
