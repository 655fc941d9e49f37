#include "services/camera_driver/core/camera_driver.h"

#include <gmock/gmock.h>

#include "test/common/capture/scripted_source.h"

namespace deixis::camera_driver {
namespace {

using capture::Grab;
using capture::Pace;
using capture::Picture;
using capture::PictureAt;
using capture::ScriptedSource;
using capture::SourceState;
using capture::SourceStatus;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<Picture> TwentyPictures() {
  std::vector<Picture> pictures;
  for (int i = 0; i < 20; ++i) pictures.push_back(PictureAt(i * 100'000));
  return pictures;
}

CameraDriver Driver(Pace pace, std::vector<Picture> pictures, SourceStatus status = {}) {
  CameraDriverConfig config;
  config.pace = pace;
  return CameraDriver(config, std::make_unique<ScriptedSource>(std::move(pictures), status));
}

TEST(CameraDriver, SaysTheCalibrationBeforeTheFirstPictureAndOncePerSecondOfPictureTime) {
  CameraDriver driver = Driver(Pace::kAsFastAsPossible, TwentyPictures());
  std::vector<std::int64_t> times;
  for (DriverOutput output = driver.Next({0}); output.picture; output = driver.Next({0})) {
    if (output.calibration) times.push_back(output.calibration->time.microseconds);
  }
  EXPECT_THAT(times, ElementsAre(0, 1'000'000));
}

TEST(CameraDriver, SaysTheCalibrationAnewWhenTheSizeChanges) {
  CameraDriver driver =
      Driver(Pace::kAsFastAsPossible, {PictureAt(0), PictureAt(100'000, {32, 24})});
  EXPECT_EQ(driver.Next({0}).calibration->width_px, 64);
  EXPECT_EQ(driver.Next({0}).calibration->width_px, 32);
}

TEST(CameraDriver, SaysThatTheCalibrationIsAGuess) {
  CameraDriver driver = Driver(Pace::kAsFastAsPossible, TwentyPictures());
  EXPECT_EQ(driver.calibration_remark(), "");
  EXPECT_FALSE(driver.Next({0}).calibration->is_calibrated);
  EXPECT_THAT(driver.calibration_remark(), HasSubstr("guessed"));
}

TEST(CameraDriver, GivesEveryRecordedPictureWhenItIsDue) {
  CameraDriver driver = Driver(Pace::kByTime, TwentyPictures());
  constexpr std::int64_t kStart_us = 5'000'000;
  EXPECT_EQ(driver.Next({kStart_us}).picture->time.microseconds, kStart_us);
  EXPECT_EQ(driver.Next({kStart_us + 50'000}).state, SourceState::kWaiting);
  EXPECT_EQ(driver.Next({kStart_us + 100'000}).picture->time.microseconds, kStart_us + 100'000);
  // Late by two pictures: none is left out.
  EXPECT_EQ(driver.Next({kStart_us + 390'000}).picture->time.microseconds, kStart_us + 200'000);
  EXPECT_EQ(driver.Next({kStart_us + 390'000}).picture->time.microseconds, kStart_us + 300'000);
}

TEST(CameraDriver, SaysThatARecordingIsPlayedLate) {
  CameraDriver driver = Driver(Pace::kByTime, TwentyPictures());
  driver.Next({0});
  EXPECT_EQ(driver.pace_trouble(), "");
  driver.Next({2'500'000});  // Of 0.1 s.
  EXPECT_THAT(driver.pace_trouble(), HasSubstr("plays 2 s late"));
}

TEST(CameraDriver, KeepsTheCaptureTimeOfLivePictures) {
  SourceStatus live;
  live.is_live = true;
  CameraDriver driver = Driver(Pace::kByTime, {PictureAt(123'456)}, live);
  EXPECT_EQ(driver.Next({999'999'999}).picture->time.microseconds, 123'456);
}

geometry::CameraCalibration OwnLens(int width_px, int height_px) {
  auto lens = geometry::GuessCalibration(width_px, height_px, 1.0);
  lens.camera = "camera_optical";
  lens.is_calibrated = true;
  return lens;
}

TEST(CameraDriver, TakesTheLensThatTheCameraSaysAtOnceAndInItsSize) {
  CameraDriver driver = Driver(Pace::kAsFastAsPossible, TwentyPictures());
  EXPECT_FALSE(driver.Next({0}).calibration->is_calibrated);
  driver.UseLens(OwnLens(128, 96));
  const auto calibration = driver.Next({0}).calibration;
  ASSERT_TRUE(calibration);
  EXPECT_TRUE(calibration->is_calibrated);
  EXPECT_EQ(calibration->camera, "CAMERA");
  EXPECT_EQ(calibration->width_px, 64);
  EXPECT_NEAR(calibration->focal_px.x(), OwnLens(128, 96).focal_px.x() / 2, 1e-9);
}

TEST(CameraDriver, SaysALensThatIsSaidAgainNoMoreOften) {
  CameraDriver driver = Driver(Pace::kAsFastAsPossible, TwentyPictures());
  int count = 0;
  for (int i = 0; i < 10; ++i) {  // 0.9 s
    driver.UseLens(OwnLens(64, 48));
    if (driver.Next({0}).calibration) ++count;
  }
  EXPECT_EQ(count, 1);
}

TEST(CameraDriver, LeavesALensOfAnotherAspectAndSaysSo) {
  CameraDriver driver = Driver(Pace::kAsFastAsPossible, TwentyPictures());
  driver.UseLens(OwnLens(64, 64));
  EXPECT_FALSE(driver.Next({0}).calibration->is_calibrated);
  EXPECT_THAT(driver.calibration_remark(), HasSubstr("64x64, another aspect"));
}

capture::MountConfig OnTheHead() { return {"base_link", {0.1, 0.0, 1.2}, {0.5, -0.5, 0.5, -0.5}}; }

CameraDriver MountedDriver(const capture::MountConfig& mount) {
  CameraDriverConfig config;
  config.pace = Pace::kAsFastAsPossible;
  config.calibration.mount = mount;
  return CameraDriver(config, std::make_unique<ScriptedSource>(TwentyPictures(), SourceStatus{}));
}

TEST(CameraDriver, SaysWhereItIsMounted) {
  const auto calibration = MountedDriver(OnTheHead()).Next({0}).calibration;
  ASSERT_TRUE(calibration && calibration->parent_from_camera);
  EXPECT_EQ(calibration->parent_frame, "base_link");
  const Eigen::Vector3d ahead = *calibration->parent_from_camera * Eigen::Vector3d(0, 0, 2);
  EXPECT_TRUE(ahead.isApprox(Eigen::Vector3d(2.1, 0.0, 1.2), 1e-12)) << ahead.transpose();
}

TEST(CameraDriver, SaysNoMountThatIsNotKnown) {
  const auto calibration = MountedDriver({}).Next({0}).calibration;
  EXPECT_FALSE(calibration->parent_from_camera);
  EXPECT_EQ(calibration->parent_frame, "");
}

TEST(CameraDriver, MountsTheLensThatTheCameraSays) {
  CameraDriver driver = MountedDriver(OnTheHead());
  driver.UseLens(OwnLens(64, 48));
  const auto calibration = driver.Next({0}).calibration;
  EXPECT_TRUE(calibration->is_calibrated);
  EXPECT_EQ(calibration->parent_frame, "base_link");
}

TEST(CameraDriver, SaysAMountAtOnceThatWasNotKnownAndAfterThatInTurn) {
  CameraDriver driver = MountedDriver({});
  driver.Next({0});
  driver.UseMount(geometry::CameraMount{"base_link", {}});
  EXPECT_EQ(driver.Next({0}).calibration->parent_frame, "base_link");
  driver.UseMount(geometry::CameraMount{"base_link", {}});
  EXPECT_FALSE(driver.Next({0}).calibration);
}

TEST(CameraDriver, FinishesWithItsSource) {
  CameraDriver driver = Driver(Pace::kAsFastAsPossible, {});
  EXPECT_EQ(driver.Next({0}).state, SourceState::kFinished);
}

}  // namespace
}  // namespace deixis::camera_driver
