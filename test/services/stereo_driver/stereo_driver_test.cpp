#include "services/stereo_driver/core/stereo_driver.h"

#include <gmock/gmock.h>

#include <deque>
#include <opencv2/core.hpp>

#include "test/services/stereo_driver/synthetic_depth.h"
#include "test/support/temporary_folder.h"

namespace deixis::stereo_driver {
namespace {

using testing::ElementsAre;

/// Gives frames at the times that it was told.
class ScriptedFrames final : public FrameSource {
 public:
  ScriptedFrames(images::StereoPair pair, std::deque<std::int64_t> times_us)
      : pair_(std::move(pair)), times_us_(std::move(times_us)) {}

  FrameGrab Next() override {
    if (times_us_.empty()) return {capture::SourceState::kFinished, std::nullopt};
    const Timestamp time{times_us_.front()};
    times_us_.pop_front();
    return {capture::SourceState::kPicture, Frame{time, pair_}};
  }
  FrameSourceStatus status() const override { return {}; }

 private:
  images::StereoPair pair_;
  std::deque<std::int64_t> times_us_;
};

class StereoDriverTest : public testing::Test {
 protected:
  StereoDriverTest() {
    const geometry::StereoCalibration rig = SyntheticRig();
    config_.calibration.intrinsics = folder_.Write("in.yml", IntrinsicsText(rig)).string();
    config_.calibration.extrinsics = folder_.Write("ex.yml", ExtrinsicsText(rig)).string();
    config_.pace = capture::Pace::kAsFastAsPossible;
    pair_ = Photograph(rig, Plane{});
    pair_.left.time = pair_.right.time = {5'000'000};
  }

  images::RgbdImage Rgbd(cv::Size size) const {
    return {{{7}, "", cv::Mat(size, CV_8UC3, cv::Scalar(1, 2, 3))},
            {{7}, "", cv::Mat(size, CV_16UC1, cv::Scalar(1500))}};
  }

  test::TemporaryFolder folder_;
  StereoDriverConfig config_;
  images::StereoPair pair_;
};

TEST_F(StereoDriverTest, MeasuresAPairThatOthersTook) {
  StereoDriver driver(config_, nullptr, KeepPairs::kNo);
  const StereoOutput output = driver.Convert(pair_);
  EXPECT_EQ(output.stereo.left.time.microseconds, 5'000'000);
  EXPECT_EQ(output.stereo.left.camera, "STEREO");
  EXPECT_EQ(output.stereo.left.width_px, 320);
  EXPECT_EQ(output.stereo.depth_mm.size(), cv::Size(160, 120));
  EXPECT_NEAR(output.stereo.depth_mm.at<std::uint16_t>(60, 90), 2000, 60);
  EXPECT_FALSE(output.pair);
}

TEST_F(StereoDriverTest, KeepsThePairWhenAsked) {
  StereoDriver driver(config_, nullptr, KeepPairs::kYes);
  const auto output = driver.Convert(pair_);
  ASSERT_TRUE(output.pair);
  EXPECT_EQ(output.pair->right.camera, "STEREO.right");
  EXPECT_EQ(output.pair->right.time.microseconds, 5'000'000);
}

TEST_F(StereoDriverTest, SaysTheCalibrationFirstAndOncePerSecondOfPictureTime) {
  auto source = std::make_unique<ScriptedFrames>(
      pair_, std::deque<std::int64_t>{0, 400'000, 800'000, 1'200'000, 2'100'000, 2'300'000});
  StereoDriver driver(config_, std::move(source), KeepPairs::kNo);
  std::vector<std::int64_t> times;
  for (StereoStep step = driver.Next({0}); step.output; step = driver.Next({0})) {
    if (step.output->calibration) times.push_back(step.output->calibration->time.microseconds);
  }
  EXPECT_THAT(times, ElementsAre(0, 1'200'000, 2'300'000));
}

TEST_F(StereoDriverTest, GivesTheCalibrationOfThePublishedPicture) {
  StereoDriver driver(config_, nullptr, KeepPairs::kNo);
  const auto calibration = driver.Convert(pair_).calibration;
  ASSERT_TRUE(calibration);
  EXPECT_EQ(calibration->camera, "STEREO");
  EXPECT_EQ(calibration->rectified.camera, "STEREO");
  EXPECT_EQ(calibration->rectified.width_px, 320);
  EXPECT_NEAR(calibration->right_from_left.translation_m.norm(), 0.12, 1e-4);
  EXPECT_GT(calibration->disparity_sigma_px, 0.0);
}

TEST_F(StereoDriverTest, PlaysARecordingByItsTimes) {
  config_.pace = capture::Pace::kByTime;
  config_.start_time_utime = 1'000'000;
  StereoDriver driver(config_,
                      std::make_unique<ScriptedFrames>(pair_, std::deque<std::int64_t>{0, 33'000}),
                      KeepPairs::kNo);
  EXPECT_EQ(driver.Next({500}).output->stereo.left.time.microseconds, 1'000'000);
  EXPECT_EQ(driver.Next({33'000}).state, capture::SourceState::kWaiting);
  EXPECT_EQ(driver.Next({33'500}).output->stereo.left.time.microseconds, 1'033'000);
}

TEST_F(StereoDriverTest, SaysThatARecordingIsPlayedLate) {
  config_.pace = capture::Pace::kByTime;
  StereoDriver driver(config_,
                      std::make_unique<ScriptedFrames>(pair_, std::deque<std::int64_t>{0, 33'000}),
                      KeepPairs::kNo);
  driver.Next({0});
  EXPECT_EQ(driver.pace_trouble(), "");
  driver.Next({2'500'000});
  EXPECT_THAT(driver.pace_trouble(), testing::HasSubstr("plays 2 s late"));
}

TEST_F(StereoDriverTest, TurnsADepthCamerasFrameIntoTheSame) {
  config_.source.kind = FrameSourceKind::kKinectChannel;
  StereoDriver driver(config_, nullptr, KeepPairs::kNo);
  const StereoOutput output = driver.Convert(Rgbd({64, 48}));
  EXPECT_EQ(output.stereo.depth_mm.at<std::uint16_t>(10, 10), 1500);
  ASSERT_TRUE(output.calibration);
  EXPECT_EQ(output.calibration->disparity_sigma_px, 0.0);
  EXPECT_EQ(output.calibration->depth_sigma_m_at_1m, 0.003);
  EXPECT_FALSE(output.calibration->rectified.is_calibrated);
  EXPECT_THAT(driver.calibration_remark(),
              testing::HasSubstr("guessed from a horizontal field of view of 57 deg; set "
                                 "depth_camera.calibration.file"));
}

class RegisteringDriverTest : public StereoDriverTest {
 protected:
  RegisteringDriverTest() {
    config_.source.kind = FrameSourceKind::kKinectChannel;
    config_.matcher.depth_size = Size::kFull;
    RegistrationConfig& registration = config_.depth_camera.registration;
    registration.mode = RegistrationMode::kExtrinsics;
    const std::string sizes = "image_width: 320\nimage_height: 240\n";
    registration.intrinsics =
        folder_.Write("cd_in.yml", ColourAndDepthIntrinsics() + sizes).string();
    registration.extrinsics = folder_.Write("cd_ex.yml", ColourAndDepthExtrinsics()).string();
  }

  const DepthScene scene_ = {{Eigen::Vector3d::UnitZ(), 2.5}, Screen{}};
  const images::RgbdImage image_ = {{{7}, "", cv::Mat(240, 320, CV_8UC3, cv::Scalar(1, 2, 3))},
                                    {{7}, "", MeasureDepth(DepthBesideColour(), scene_)},
                                    /*is_registered=*/false};
};

TEST_F(RegisteringDriverTest, GivesDepthOfTheViewThatItsCalibrationSays) {
  StereoDriver driver(config_, nullptr, KeepPairs::kNo);
  const StereoOutput output = driver.Convert(image_);
  ASSERT_TRUE(output.calibration);
  const geometry::CameraCalibration& said = output.calibration->rectified;
  EXPECT_TRUE(said.focal_px.isApprox(ColourLens().focal_px));
  EXPECT_TRUE(said.is_calibrated);
  EXPECT_TRUE(output.calibration->left.focal_px.isApprox(ColourLens().focal_px));
  EXPECT_TRUE(output.calibration->right_from_left.translation_m.isZero());
  const cv::Mat truth_mm = MeasureDepth(said, {}, scene_);
  const cv::Mat& depth_mm = output.stereo.depth_mm;
  ASSERT_EQ(depth_mm.size(), truth_mm.size());
  cv::Mat difference_mm;
  cv::absdiff(depth_mm, truth_mm, difference_mm);
  const cv::Mat is_off = (difference_mm > 3) & (depth_mm > 0);
  EXPECT_LT(cv::countNonZero(is_off), 400);  // Half a pixel along the screen's edge.
  EXPECT_EQ(driver.registration_fault(), "");
}

TEST_F(RegisteringDriverTest, TakesDepthThatChangesItsSize) {
  StereoDriver driver(config_, nullptr, KeepPairs::kNo);
  driver.Convert(image_);
  images::RgbdImage small = image_;
  small.depth.depth_mm = cv::Mat(120, 160, CV_16UC1, cv::Scalar(1500));
  EXPECT_EQ(driver.Convert(small).stereo.depth_mm.size(), cv::Size(320, 240));
  images::RgbdImage square = image_;
  square.depth.depth_mm = cv::Mat(100, 100, CV_16UC1, cv::Scalar(1500));
  EXPECT_THROW(driver.Convert(square), std::runtime_error);
  EXPECT_EQ(driver.Convert(image_).stereo.depth_mm.size(), cv::Size(320, 240));
}

TEST_F(RegisteringDriverTest, SaysWhenTheSensorHasRegisteredAlready) {
  StereoDriver driver(config_, nullptr, KeepPairs::kNo);
  images::RgbdImage registered = image_;
  registered.is_registered = true;
  driver.Convert(registered);
  EXPECT_THAT(driver.registration_fault(), testing::HasSubstr("mode to sensor"));
  driver.Convert(image_);
  EXPECT_EQ(driver.registration_fault(), "");
}

TEST_F(RegisteringDriverTest, TakesNoOtherSourcesWordForIt) {
  config_.source.kind = FrameSourceKind::kDimos;
  StereoDriver driver(config_, nullptr, KeepPairs::kNo);
  images::RgbdImage image = image_;
  image.is_registered = true;
  driver.Convert(image);
  EXPECT_EQ(driver.registration_fault(), "");
}

TEST_F(RegisteringDriverTest, TakesTheFilesLensBeforeTheCamerasOwn) {
  config_.source.kind = FrameSourceKind::kDimos;
  StereoDriver driver(config_, nullptr, KeepPairs::kNo);
  driver.UseLens(geometry::GuessCalibration(320, 240, 1.0));
  EXPECT_TRUE(
      driver.Convert(image_).calibration->rectified.focal_px.isApprox(ColourLens().focal_px));
}

TEST_F(RegisteringDriverTest, TakesTheCamerasOwnLensBesideADepthLens) {
  config_.source.kind = FrameSourceKind::kDimos;
  RegistrationConfig& registration = config_.depth_camera.registration;
  registration.depth_lens = registration.intrinsics;
  registration.intrinsics.clear();
  StereoDriver driver(config_, nullptr, KeepPairs::kNo);
  const auto own = geometry::GuessCalibration(320, 240, 1.0);
  driver.UseLens(own);
  EXPECT_TRUE(driver.Convert(image_).calibration->rectified.focal_px.isApprox(own.focal_px));
}

TEST(StereoDriverConfig, AsksOnlyOfPairsThatDepthIsNotLargerThanWhatIsMatched) {
  StereoDriverConfig config;
  config.matcher.match_size = MatchSize::kHalf;
  config.matcher.depth_size = Size::kFull;
  const auto checking = [&config](FrameSourceKind kind) {
    config.source.kind = kind;
    return [&config] {
      config::Faults faults;
      config.Check(faults);
      faults.ThrowIfAny();
    };
  };
  EXPECT_THAT(
      checking(FrameSourceKind::kPairChannel),
      testing::ThrowsMessage<config::ConfigError>(testing::HasSubstr("matcher.depth_size")));
  EXPECT_NO_THROW(checking(FrameSourceKind::kKinectChannel)());
}

TEST(DepthCameraConfig, NamesTwoFilesForOneLens) {
  DepthCameraConfig config;
  config.registration.mode = RegistrationMode::kExtrinsics;
  config.registration.intrinsics = "intrinsics.yml";
  config.calibration.file = "colour.yml";
  EXPECT_THAT(
      [&] { config.Validate(); },
      testing::ThrowsMessage<config::ConfigError>(testing::AllOf(
          testing::HasSubstr("calibration.file"), testing::HasSubstr("registration.intrinsics"))));
}

TEST_F(StereoDriverTest, SaysOfADepthCameraThatNothingIsTurned) {
  config_.source.kind = FrameSourceKind::kDimos;
  StereoDriver driver(config_, nullptr, KeepPairs::kNo);
  auto lens = geometry::GuessCalibration(64, 48, 1.0);
  lens.rectification = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY()).toRotationMatrix();
  driver.UseLens(lens);
  const auto calibration = driver.Convert(Rgbd({64, 48})).calibration;
  ASSERT_TRUE(calibration);
  EXPECT_EQ(calibration->rectified.focal_px, lens.focal_px);
  for (const auto* camera : {&calibration->left, &calibration->right, &calibration->rectified}) {
    EXPECT_TRUE(camera->rectification.isIdentity());
  }
}

TEST_F(StereoDriverTest, SaysTheCalibrationAnewWhenTheSizeChanges) {
  config_.source.kind = FrameSourceKind::kKinectChannel;
  StereoDriver driver(config_, nullptr, KeepPairs::kNo);
  driver.Convert(Rgbd({64, 48}));
  EXPECT_FALSE(driver.Convert(Rgbd({64, 48})).calibration);
  EXPECT_EQ(driver.Convert(Rgbd({128, 96})).calibration->rectified.width_px, 128);
}

TEST_F(StereoDriverTest, SaysWhereEachCameraIsMounted) {
  config_.calibration.mount = {"base_link", {0.1, 0.0, 1.2}, {0.5, -0.5, 0.5, -0.5}};
  StereoDriver driver(config_, nullptr, KeepPairs::kNo);
  const auto rig = driver.Convert(pair_).calibration;
  ASSERT_TRUE(rig && rig->left.parent_from_camera && rig->right.parent_from_camera &&
              rig->rectified.parent_from_camera);
  const Eigen::Vector3d in_left(0.2, -0.1, 1.5);
  const Eigen::Vector3d in_base(0.1 + 1.5, -0.2, 1.2 + 0.1);
  for (const auto& [camera, point] :
       {std::pair{rig->left, in_left}, std::pair{rig->right, rig->right_from_left * in_left},
        std::pair{rig->rectified, Eigen::Vector3d(rig->left.rectification * in_left)}}) {
    EXPECT_EQ(camera.parent_frame, "base_link");
    EXPECT_NEAR((*camera.parent_from_camera * point - in_base).norm(), 0.0, 1e-9) << camera.camera;
  }
}

TEST_F(StereoDriverTest, ADepthCamerasThreeAreOne) {
  config_.source.kind = FrameSourceKind::kKinectChannel;
  config_.depth_camera.calibration.mount = {"head", {0.0, 0.0, 0.5}, {1.0, 0.0, 0.0, 0.0}};
  StereoDriver driver(config_, nullptr, KeepPairs::kNo);
  const auto rig = driver.Convert(Rgbd({64, 48})).calibration;
  for (const auto& camera : {rig->left, rig->right, rig->rectified}) {
    EXPECT_EQ(camera.parent_frame, "head");
    EXPECT_EQ(camera.parent_from_camera->translation_m, Eigen::Vector3d(0.0, 0.0, 0.5));
    EXPECT_EQ(camera.parent_from_camera->rotation.w(), 1.0);
  }
}

TEST_F(StereoDriverTest, SaysNothingOfARectificationThatADepthCamerasPicturesDoNotHave) {
  config_.source.kind = FrameSourceKind::kDimos;
  StereoDriver driver(config_, nullptr, KeepPairs::kNo);
  geometry::CameraCalibration lens = geometry::GuessCalibration(64, 48, 1.0);
  lens.rectification = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY()).toRotationMatrix();
  driver.UseLens(lens);
  EXPECT_TRUE(driver.Convert(Rgbd({64, 48})).calibration->left.rectification.isIdentity(0.0));
}

TEST_F(StereoDriverTest, RefusesPairsOfAnotherAspectThanTheCalibrationAndGoesOn) {
  config_.calibration.width_px = 320;
  config_.calibration.height_px = 240;
  StereoDriver driver(config_, nullptr, KeepPairs::kNo);
  images::StereoPair wide = pair_;
  wide.left.bgr = wide.right.bgr = cv::Mat(120, 320, CV_8UC3, cv::Scalar(0, 0, 0));
  EXPECT_THROW(driver.Convert(wide), UnusableFrame);
  EXPECT_EQ(driver.Convert(pair_).stereo.left.width_px, 320);
}

TEST_F(StereoDriverTest, NamesACalibrationThatIsNotThere) {
  config_.calibration.intrinsics = "/nowhere/intrinsics.yml";
  EXPECT_THAT([&] { StereoDriver(config_, nullptr, KeepPairs::kNo); },
              testing::ThrowsMessage<config::ConfigError>(testing::HasSubstr("/nowhere/")));
}

}  // namespace
}  // namespace deixis::stereo_driver
