#include "services/camera_driver/camera_driver_service.h"

#include <gmock/gmock.h>

#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <sensor_msgs/CameraInfo.hpp>
#include <sensor_msgs/Image.hpp>

#include "common/messages/camera_calibration.h"
#include "common/messages/camera_pose.h"
#include "common/messages/frame_transforms.h"
#include "common/messages/image.h"
#include "test/support/memory_bus.h"
#include "test/support/temporary_folder.h"

namespace deixis::camera_driver {
namespace {

using capture::Pace;
using capture::SourceKind;
using testing::ElementsAre;
using testing::HasSubstr;

class CameraDriverServiceTest : public testing::Test {
 protected:
  CameraDriverServiceTest() {
    config_.driver.source.kind = SourceKind::kVideo;
    config_.driver.source.path = (folder_.path() / "clip.avi").string();
    config_.driver.pace = Pace::kAsFastAsPossible;
    cv::VideoWriter writer(config_.driver.source.path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                           20.0, {64, 48});
    for (int i = 0; i < 3; ++i) writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(50 * i)));
  }
  void RunToTheEnd(CameraDriverService& service) {
    while (service.Step() != program::StepResult::kFinished) {
    }
    test::HandleAll(bus_);
  }
  test::TemporaryFolder folder_;
  CameraDriverServiceConfig config_;
  transport::Bus bus_{test::Memory()};
};

TEST_F(CameraDriverServiceTest, PublishesEveryPictureOfAFileThenFinishes) {
  std::vector<std::int64_t> times;
  bus_.Subscribe<images::Image>(
      "CAMERA", transport::Delivery::kEvery,
      [&times](const images::Image& image) { times.push_back(image.time.microseconds); });
  CameraDriverService service(config_, bus_, bus_);
  RunToTheEnd(service);
  EXPECT_THAT(times, ElementsAre(0, 50'000, 100'000));
}

TEST_F(CameraDriverServiceTest, PublishesTheCalibrationFirst) {
  std::vector<std::string> order;
  bus_.Subscribe<images::Image>("CAMERA", transport::Delivery::kEvery,
                                [&order](const images::Image&) { order.push_back("picture"); });
  bus_.Subscribe<geometry::CameraCalibration>(
      "CAMERA_CALIBRATION", transport::Delivery::kEvery,
      [&order](const geometry::CameraCalibration&) { order.push_back("calibration"); });
  CameraDriverService service(config_, bus_, bus_);
  RunToTheEnd(service);
  EXPECT_THAT(order, ElementsAre("calibration", "picture", "picture", "picture"));
}

TEST_F(CameraDriverServiceTest, SaysInItsHealthThatTheCalibrationIsAGuess) {
  CameraDriverService service(config_, bus_, bus_);
  service.Step();
  EXPECT_FALSE(service.health().is_degraded);
  EXPECT_THAT(service.health().text, HasSubstr("guessed"));
}

TEST_F(CameraDriverServiceTest, DoesNotStartWithoutItsSource) {
  config_.driver.source.path += ".missing";
  EXPECT_THROW(CameraDriverService(config_, bus_, bus_), config::ConfigError);
}

TEST_F(CameraDriverServiceTest, SumsUpARecordingAtItsEnd) {
  config_.driver.source.kind = SourceKind::kFolder;
  config_.driver.source.path = folder_.path().string();
  config_.driver.source.rate_hz = 10.0;
  cv::imwrite((folder_.path() / "1.png").string(), cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(9)));
  folder_.Write("2.png", "this is no picture");
  CameraDriverService service(config_, bus_, bus_);
  testing::internal::CaptureStderr();
  RunToTheEnd(service);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::AllOf(HasSubstr("warning"), HasSubstr("published=1 unreadable=1"),
                             HasSubstr("2.png")));
}

TEST_F(CameraDriverServiceTest, FailsWhenNoPictureOfARecordingCanBeRead) {
  config_.driver.source.kind = SourceKind::kFolder;
  config_.driver.source.path = folder_.path().string();
  config_.driver.source.rate_hz = 10.0;
  folder_.Write("1.png", "this is no picture");
  CameraDriverService service(config_, bus_, bus_);
  EXPECT_THAT([&] { RunToTheEnd(service); },
              testing::ThrowsMessage<config::ConfigError>(
                  testing::AllOf(HasSubstr("no picture of"), HasSubstr("1 tried"))));
}

TEST_F(CameraDriverServiceTest, RefusesTimesThatWouldOverflow) {
  config_.driver.start_time_utime = std::numeric_limits<std::int64_t>::max();
  config_.driver.source.rate_hz = 1e-300;
  EXPECT_THAT([this] { config_.Validate(); },
              testing::ThrowsMessage<config::ConfigError>(
                  testing::AllOf(HasSubstr("start_time_utime"), HasSubstr("source.rate_hz"))));
}

TEST_F(CameraDriverServiceTest, RefusesOneChannelForTwoTypes) {
  config_.calibration_channel = config_.image_channel;
  config_.driver.camera = std::string("CAM\0ERA", 7);
  EXPECT_THAT([this] { config_.Validate(); },
              testing::ThrowsMessage<config::ConfigError>(testing::AllOf(
                  HasSubstr("'calibration_channel' must be another channel than image_channel"),
                  HasSubstr("'camera' must be"))));
}

TEST_F(CameraDriverServiceTest, NamesEveryFaultOfItsConfiguration) {
  config_.image_channel = "";
  config_.driver.image.jpeg_quality = 500;
  config_.driver.source.fourcc = "MJP";
  EXPECT_THAT([this] { config_.Validate(); },
              testing::ThrowsMessage<config::ConfigError>(
                  testing::AllOf(HasSubstr("image_channel"), HasSubstr("image.jpeg_quality"),
                                 HasSubstr("source.fourcc"))));
}

template <typename Message>
void Send(transport::Bus& bus, const std::string& channel, const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  bus.PublishRaw(channel, {bytes.data(), bytes.size()}, {0});
}

std_msgs::Header RobotHeader(std::int32_t sec) {
  std_msgs::Header header{};
  header.stamp.sec = sec;
  header.stamp.nsec = 250'000'000;
  header.frame_id = "camera_optical";
  return header;
}

sensor_msgs::Image RobotPicture(std::int32_t sec) {
  sensor_msgs::Image message{};
  message.header = RobotHeader(sec);
  message.width = 64;
  message.height = 48;
  message.step = 64 * 3;
  message.encoding = "rgb8";
  for (int i = 0; i < 64 * 48; ++i) message.data.insert(message.data.end(), {200, 100, 50});
  message.data_length = static_cast<std::int32_t>(message.data.size());
  return message;
}

sensor_msgs::CameraInfo RobotLens(std::int32_t sec) {
  sensor_msgs::CameraInfo message{};
  message.header = RobotHeader(sec);
  message.width = 64;
  message.height = 48;
  message.K[0] = message.K[4] = 70.0;
  message.K[2] = 31.5;
  message.K[5] = 23.5;
  message.K[8] = 1.0;
  return message;
}

class DimosCamera : public testing::Test {
 protected:
  DimosCamera() : bus_(PrefixedOptions()) {
    config_.driver.source.kind = SourceKind::kDimos;
    bus_.Subscribe<images::Image>("CAMERA", transport::Delivery::kEvery,
                                  [this](const auto& image) { pictures_.push_back(image); });
    bus_.Subscribe<geometry::CameraCalibration>(
        "CAMERA_CALIBRATION", transport::Delivery::kEvery,
        [this](const auto& lens) { lenses_.push_back(lens); });
  }
  static transport::BusOptions PrefixedOptions() {
    transport::BusOptions options = test::Memory();
    options.channel_prefix = "DEIXIS_";  // The robot's channels have none.
    return options;
  }
  void Exchange(CameraDriverService& service) {
    test::HandleAll(bus_);
    while (service.Step() == program::StepResult::kContinue) {
    }
    test::HandleAll(bus_);
  }
  CameraDriverServiceConfig config_;
  transport::Bus bus_;
  std::vector<images::Image> pictures_;
  std::vector<geometry::CameraCalibration> lenses_;
};

TEST_F(DimosCamera, PicturesGoOnWithTheirTimesUnderTheConfiguredName) {
  CameraDriverService service(config_, bus_, bus_);
  Send(bus_, config_.dimos.info_channel, RobotLens(1'700'000'000));
  Send(bus_, config_.dimos.image_channel, RobotPicture(1'700'000'000));
  Exchange(service);
  ASSERT_EQ(pictures_.size(), 1U);
  EXPECT_EQ(pictures_[0].time.microseconds, 1'700'000'000'250'000);
  EXPECT_EQ(pictures_[0].camera, "CAMERA");
  EXPECT_EQ(pictures_[0].bgr.size(), cv::Size(64, 48));
  EXPECT_NEAR(cv::mean(pictures_[0].bgr)[2], 200, 3);
}

TEST_F(DimosCamera, TheLensIsThatOfTheRobotWithTheTimeOfThePicture) {
  CameraDriverService service(config_, bus_, bus_);
  Send(bus_, config_.dimos.info_channel, RobotLens(1'699'999'990));
  Send(bus_, config_.dimos.image_channel, RobotPicture(1'700'000'000));
  Exchange(service);
  ASSERT_EQ(lenses_.size(), 1U);
  EXPECT_TRUE(lenses_[0].is_calibrated);
  EXPECT_EQ(lenses_[0].camera, "CAMERA");
  EXPECT_EQ(lenses_[0].focal_px, Eigen::Vector2d(70.0, 70.0));
  EXPECT_EQ(lenses_[0].time, pictures_.at(0).time);
  EXPECT_EQ(service.health().text, "");
}

TEST_F(DimosCamera, PicturesThatComeBeforeTheLensAreHeldBackAndCounted) {
  CameraDriverService service(config_, bus_, bus_);
  Send(bus_, config_.dimos.image_channel, RobotPicture(10));
  Exchange(service);
  EXPECT_TRUE(lenses_.empty());
  EXPECT_THAT(service.health().text, HasSubstr("1 skipped pictures"));
  Send(bus_, config_.dimos.info_channel, RobotLens(10));
  Send(bus_, config_.dimos.image_channel, RobotPicture(11));
  Exchange(service);
  ASSERT_EQ(lenses_.size(), 1U);
  EXPECT_TRUE(lenses_[0].is_calibrated);
  EXPECT_EQ(pictures_.size(), 1U);
}

TEST_F(DimosCamera, TheLensOfARobotThatSaysNoneIsGuessedAfterTwoSeconds) {
  CameraDriverService service(config_, bus_, bus_);
  for (const std::int32_t sec : {10, 11, 12, 13}) {
    Send(bus_, config_.dimos.image_channel, RobotPicture(sec));
    Exchange(service);
  }
  ASSERT_EQ(pictures_.size(), 2U);
  EXPECT_EQ(pictures_[0].time.microseconds, 12'250'000);
  EXPECT_FALSE(lenses_.at(0).is_calibrated);
  EXPECT_THAT(service.health().text, HasSubstr("guessed"));
}

TEST_F(DimosCamera, BadPicturesAreCountedAndTheNextIsTaken) {
  CameraDriverService service(config_, bus_, bus_);
  Send(bus_, config_.dimos.info_channel, RobotLens(1));
  auto bad = RobotPicture(1);
  bad.encoding = "32FC1";
  Send(bus_, config_.dimos.image_channel, bad);
  Exchange(service);
  EXPECT_TRUE(pictures_.empty());
  Send(bus_, config_.dimos.image_channel, RobotPicture(2));
  Exchange(service);
  EXPECT_EQ(pictures_.size(), 1U);
  for (const auto& channel : bus_.statistics()) {
    if (channel.channel != config_.dimos.image_channel) continue;
    EXPECT_THAT(channel.drops, ElementsAre(testing::Pair("bad_pixel_format", 1)));
    return;
  }
  FAIL() << "no statistics of the robot's channel";
}

geometry::FrameTransform Transform(const std::string& parent, const std::string& child,
                                   const Eigen::Vector3d& by_m, std::int64_t time_us) {
  return {{time_us}, parent, child, {Eigen::Quaterniond::Identity(), by_m}};
}

/// The robot's base holds a neck, that holds the camera whose pictures name "camera_optical".
class DimosTransforms : public DimosCamera {
 protected:
  DimosTransforms() {
    config_.driver.calibration.mount.parent_frame = "base_link";
    bus_.Subscribe<geometry::CameraPose>("CAMERA_POSE", transport::Delivery::kEvery,
                                         [this](const auto& pose) { poses_.push_back(pose); });
  }
  void SendPicture(CameraDriverService& service, std::int32_t sec) {
    Send(bus_, config_.dimos.info_channel, RobotLens(sec));
    Send(bus_, config_.dimos.image_channel, RobotPicture(sec));
    Exchange(service);
  }
  void SendTransforms(CameraDriverService& service, const geometry::FrameTransforms& transforms) {
    const auto bytes = messages::Codec<geometry::FrameTransforms>::Encode(transforms, 0);
    bus_.PublishRaw("/tf#tf2_msgs.TFMessage", {bytes.data(), bytes.size()}, {0});
    Exchange(service);
  }
  void ExpectNoneIsFollowed() {
    config_.Validate();
    CameraDriverService service(config_, bus_, bus_);
    SendPicture(service, 1);
    SendTransforms(service, chain_);
    EXPECT_FALSE(service.health().is_degraded);
    EXPECT_TRUE(poses_.empty());
  }
  const geometry::FrameTransforms chain_{
      Transform("base_link", "neck", {0, 0, 1}, 7'000'000),
      Transform("neck", "camera_optical", {0.2, 0, 0}, 8'000'000)};
  std::vector<geometry::CameraPose> poses_;
};

TEST_F(DimosTransforms, BecomePosesOfTheCameraThatThePicturesName) {
  CameraDriverService service(config_, bus_, bus_);
  SendPicture(service, 1);
  SendTransforms(service, chain_);
  ASSERT_EQ(poses_.size(), 1U);
  EXPECT_EQ(poses_[0].time.microseconds, 8'000'000);
  EXPECT_TRUE(poses_[0].parent_from_camera.translation_m.isApprox(Eigen::Vector3d(0.2, 0, 1)));
  SendTransforms(service, {Transform("base_link", "wheel", {0, 1, 0}, 9'000'000)});
  EXPECT_EQ(poses_.size(), 1U);
}

TEST_F(DimosTransforms, TheLensNamesTheCameraUntilAPictureDoes) {
  CameraDriverService service(config_, bus_, bus_);
  Send(bus_, config_.dimos.info_channel, RobotLens(1));
  Exchange(service);
  SendTransforms(service, chain_);
  EXPECT_EQ(poses_.size(), 1U);
}

TEST_F(DimosTransforms, TheConfigurationNamesTheCameraBeforeAll) {
  config_.dimos.camera_frame = "neck";
  CameraDriverService service(config_, bus_, bus_);
  SendPicture(service, 1);
  SendTransforms(service, chain_);
  ASSERT_EQ(poses_.size(), 1U);
  EXPECT_EQ(poses_[0].time.microseconds, 7'000'000);
}

TEST_F(DimosTransforms, TheCalibrationSaysNoMountUntilTheChainIsComplete) {
  CameraDriverService service(config_, bus_, bus_);
  SendPicture(service, 1);
  EXPECT_FALSE(lenses_.at(0).parent_from_camera);
  SendTransforms(service, chain_);
  SendPicture(service, 1);
  ASSERT_EQ(lenses_.size(), 2U);
  EXPECT_EQ(lenses_[1].parent_frame, "base_link");
  EXPECT_TRUE(lenses_[1].parent_from_camera->translation_m.isApprox(Eigen::Vector3d(0.2, 0, 1)));
}

TEST_F(DimosTransforms, AMountThatIsGivenHoldsUntilTheChainIsComplete) {
  config_.driver.calibration.mount.translation_m = {0, 0, 5};
  CameraDriverService service(config_, bus_, bus_);
  SendPicture(service, 1);
  EXPECT_EQ(lenses_.at(0).parent_from_camera->translation_m, Eigen::Vector3d(0, 0, 5));
  SendTransforms(service, chain_);
  SendPicture(service, 3);
  EXPECT_TRUE(lenses_.at(1).parent_from_camera->translation_m.isApprox(Eigen::Vector3d(0.2, 0, 1)));
}

TEST_F(DimosTransforms, TheStatusSaysWhichLinkLacks) {
  CameraDriverService service(config_, bus_, bus_);
  EXPECT_THAT(service.health().text, HasSubstr("camera's frame is not known"));
  SendPicture(service, 1);
  SendTransforms(service, {chain_[0]});
  EXPECT_TRUE(service.health().is_degraded);
  EXPECT_THAT(service.health().text, HasSubstr("no transform names 'camera_optical'"));
  SendTransforms(service, {chain_[1]});
  EXPECT_FALSE(service.health().is_degraded);
  EXPECT_THAT(service.health().text, testing::Not(HasSubstr("transform")));
}

TEST_F(DimosTransforms, AreNotFollowedWithoutAParent) {
  config_.driver.calibration.mount.parent_frame = "";
  ExpectNoneIsFollowed();
}

TEST_F(DimosTransforms, AreNotFollowedWithoutAChannel) {
  config_.dimos.tf_channel = "";
  ExpectNoneIsFollowed();
}

TEST_F(DimosTransforms, HostileOnesAreCountedAndTheNextAreTaken) {
  CameraDriverService service(config_, bus_, bus_);
  SendPicture(service, 1);
  geometry::FrameTransforms bad = chain_;
  bad[0].parent_from_child.rotation.coeffs() *= 3.0;
  SendTransforms(service, bad);
  EXPECT_TRUE(poses_.empty());
  SendTransforms(service, chain_);
  EXPECT_EQ(poses_.size(), 1U);
  for (const auto& channel : bus_.statistics()) {
    if (channel.channel != config_.dimos.tf_channel) continue;
    EXPECT_THAT(channel.drops, ElementsAre(testing::Pair("not_a_rotation", 1)));
    return;
  }
  FAIL() << "no statistics of the robot's channel";
}

TEST_F(DimosCamera, PicturesThatTheLensFileDoesNotSuitAreCountedAndTheNextIsTaken) {
  const test::TemporaryFolder folder;
  config_.driver.calibration.file =
      folder
          .Write("lens.yml",
                 "%YAML:1.0\nimage_width: 64\nimage_height: 48\n"
                 "M1: !!opencv-matrix\n  rows: 3\n  cols: 3\n  dt: d\n"
                 "  data: [70., 0., 32., 0., 70., 24., 0., 0., 1.]\n"
                 "D1: !!opencv-matrix\n  rows: 1\n  cols: 5\n  dt: d\n"
                 "  data: [0., 0., 0., 0., 0.]\n")
          .string();
  CameraDriverService service(config_, bus_, bus_);
  auto flat = RobotPicture(1);
  flat.height = 24;
  Send(bus_, config_.dimos.image_channel, flat);
  Exchange(service);
  EXPECT_TRUE(pictures_.empty());
  Send(bus_, config_.dimos.image_channel, RobotPicture(2));
  Exchange(service);
  EXPECT_EQ(pictures_.size(), 1U);
}

TEST_F(DimosCamera, ChannelsMustBeNames) {
  config_.dimos.info_channel = "/camera info";
  config_.dimos.image_channel = "";
  EXPECT_THAT([this] { config_.Validate(); },
              testing::ThrowsMessage<config::ConfigError>(testing::AllOf(
                  HasSubstr("dimos.image_channel"), HasSubstr("dimos.info_channel"))));
}

TEST(PlayingClock, GoesOnEvenlyWhenTheWallClockIsSet) {
  std::int64_t wall_us = 5'000'000;
  std::int64_t monotonic_us = 100;
  const capture::PlayingClock clock(
      {[&] { return Timestamp{wall_us}; }, [&] { return Timestamp{monotonic_us}; }});
  monotonic_us += 40'000;
  wall_us -= 3'600'000'000;
  EXPECT_EQ(clock.Now().microseconds, 5'040'000);
}

}  // namespace
}  // namespace deixis::camera_driver
