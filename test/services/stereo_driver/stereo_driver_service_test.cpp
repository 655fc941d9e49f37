#include "services/stereo_driver/stereo_driver_service.h"

#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>

#include "common/messages/body_poses.h"
#include "common/messages/camera_calibration.h"
#include "common/messages/camera_pose.h"
#include "common/messages/depth_image.h"
#include "common/messages/frame_transforms.h"
#include "common/messages/image.h"
#include "common/messages/rgbd_image.h"
#include "common/messages/stereo_calibration.h"
#include "common/messages/stereo_image.h"
#include "common/messages/stereo_pair.h"
#include "test/services/stereo_driver/synthetic_depth.h"
#include "test/support/memory_bus.h"
#include "test/support/temporary_folder.h"

namespace deixis::stereo_driver {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// All ways to the same: one pair of a plane, whatever way it comes, ends on STEREO.
class StereoDriverServiceTest : public testing::Test {
 protected:
  StereoDriverServiceTest() : pair_(Photograph(SyntheticRig(), Plane{})) {
    const geometry::StereoCalibration rig = SyntheticRig();
    StereoDriverConfig& driver = config_.driver;
    driver.calibration.intrinsics = folder_.Write("in.yml", IntrinsicsText(rig)).string();
    driver.calibration.extrinsics = folder_.Write("ex.yml", ExtrinsicsText(rig)).string();
    driver.pace = capture::Pace::kAsFastAsPossible;
    pair_.left.time = pair_.right.time = {0};
    bus_.Subscribe<images::StereoImage>(
        "STEREO", transport::Delivery::kEvery,
        [this](const images::StereoImage& stereo) { received_.push_back(stereo); });
  }

  void UseFolders(FrameSourceKind kind) {
    config_.driver.source.kind = kind;
    for (auto* source : {&config_.driver.source.left, &config_.driver.source.right}) {
      source->kind = capture::SourceKind::kFolder;
      source->path = folder_.path().string();
      source->rate_hz = 10.0;
    }
    config_.driver.source.left.pattern = "left*.png";
    config_.driver.source.right.pattern = "right*.png";
  }
  void Write(const std::string& name, const cv::Mat& picture) const {
    ASSERT_TRUE(cv::imwrite((folder_.path() / name).string(), picture));
  }
  void RunToTheEnd() {
    StereoDriverService service(config_, bus_, bus_);
    while (service.Step() != program::StepResult::kFinished) {
    }
    test::HandleAll(bus_);
  }
  std::map<std::string, std::int64_t> DropsOn(const std::string& channel) const {
    for (const auto& statistics : bus_.statistics()) {
      if (statistics.channel == channel) return statistics.drops;
    }
    return {};
  }
  void ExpectThePlane(const images::StereoImage& stereo) const {
    EXPECT_EQ(stereo.left.camera, "STEREO");
    EXPECT_EQ(stereo.depth_mm.size(), cv::Size(160, 120));
    EXPECT_NEAR(stereo.depth_mm.at<std::uint16_t>(60, 90), 2000, 60);
  }

  test::TemporaryFolder folder_;
  StereoDriverServiceConfig config_;
  images::StereoPair pair_;
  transport::Bus bus_{test::Memory()};
  std::vector<images::StereoImage> received_;
};

TEST_F(StereoDriverServiceTest, TakesTwoRecordings) {
  UseFolders(FrameSourceKind::kTwoCameras);
  for (const std::string name : {"1.png", "2.png"}) {
    Write("left" + name, pair_.left.bgr);
    Write("right" + name, pair_.right.bgr);
  }
  RunToTheEnd();
  ASSERT_EQ(received_.size(), 2u);
  ExpectThePlane(received_[1]);
  EXPECT_EQ(received_[1].left.time.microseconds, 100'000);
}

TEST_F(StereoDriverServiceTest, TakesOneRecordingWithBothViews) {
  UseFolders(FrameSourceKind::kSideBySide);
  cv::Mat both;
  cv::hconcat(pair_.left.bgr, pair_.right.bgr, both);
  Write("left.png", both);
  RunToTheEnd();
  ASSERT_EQ(received_.size(), 1u);
  ExpectThePlane(received_[0]);
}

TEST_F(StereoDriverServiceTest, TakesFoldersOfColourAndDepth) {
  UseFolders(FrameSourceKind::kColourAndDepth);
  Write("left.png", pair_.left.bgr);
  Write("right.png", cv::Mat(240, 320, CV_16UC1, cv::Scalar(2000)));
  RunToTheEnd();
  ASSERT_EQ(received_.size(), 1u);
  ExpectThePlane(received_[0]);
}

TEST_F(StereoDriverServiceTest, CountsDepthOfAnotherViewAndGoesOn) {
  UseFolders(FrameSourceKind::kColourAndDepth);
  Write("left1.png", pair_.left.bgr);
  Write("left2.png", pair_.left.bgr);
  Write("right1.png", cv::Mat(180, 320, CV_16UC1, cv::Scalar(2000)));
  Write("right2.png", cv::Mat(240, 320, CV_16UC1, cv::Scalar(2000)));
  StereoDriverService service(config_, bus_, bus_);
  while (service.Step() != program::StepResult::kFinished) {
  }
  test::HandleAll(bus_);
  EXPECT_EQ(received_.size(), 1u);
  EXPECT_THAT(DropsOn("STEREO"), IsEmpty());
  EXPECT_THAT(service.health().text, HasSubstr("1 pictures that make no pair"));
}

TEST_F(StereoDriverServiceTest, CountsAKinectsDepthOfAnotherViewAndGoesOn) {
  config_.driver.source.kind = FrameSourceKind::kKinectChannel;
  StereoDriverService service(config_, bus_, bus_);
  bus_.Publish("KINECT_FRAME",
               images::RgbdImage{{{5}, "", pair_.left.bgr},
                                 {{5}, "", cv::Mat(180, 320, CV_16UC1, cv::Scalar(2000))}});
  test::HandleAll(bus_);
  EXPECT_TRUE(received_.empty());
  EXPECT_THAT(DropsOn("KINECT_FRAME"), IsEmpty());
  EXPECT_THAT(service.health().text, HasSubstr("1 pictures that make no pair"));
}

TEST_F(StereoDriverServiceTest, CountsPairsThatAreTooSmallAndGoesOn) {
  config_.driver.source.kind = FrameSourceKind::kPairChannel;
  StereoDriverService service(config_, bus_, bus_);
  std::int64_t unusable = 0;
  for (const cv::Size size :
       {cv::Size(1, 1), {2, 40}, {40, 3}, {40, 3}, {16, 16}, {17, 33}, {40, 3}, {33, 17}}) {
    if (std::min(size.width, size.height) < 16) ++unusable;
    const cv::Mat bgr(size, CV_8UC3, cv::Scalar(1, 2, 3));
    bus_.Publish("STEREO_PAIR", images::StereoPair{{{1}, "", bgr}, {{1}, "", bgr}});
    test::HandleAll(bus_);
  }
  EXPECT_THAT(DropsOn("STEREO_PAIR"), IsEmpty());
  EXPECT_EQ(received_.size(), 3u);
  EXPECT_THAT(service.health().text, HasSubstr(std::to_string(unusable) + " pictures that make"));
  EXPECT_THAT(service.health().text, HasSubstr("pictures of 40x3 are too small to be matched"));
}

TEST_F(StereoDriverServiceTest, MatchesRecordedPairsAgainToTheSame) {
  UseFolders(FrameSourceKind::kTwoCameras);
  Write("left.png", pair_.left.bgr);
  Write("right.png", pair_.right.bgr);
  RunToTheEnd();
  config_.driver.source.kind = FrameSourceKind::kPairChannel;
  StereoDriverService service(config_, bus_, bus_);
  bus_.Publish("STEREO_PAIR", pair_);
  test::HandleAll(bus_);
  ASSERT_EQ(received_.size(), 2u);
  ExpectThePlane(received_[1]);
  EXPECT_EQ(cv::norm(received_[0].depth_mm, received_[1].depth_mm, cv::NORM_INF), 0.0);
  EXPECT_EQ(received_[0].left.jpeg, received_[1].left.jpeg);
}

TEST_F(StereoDriverServiceTest, TakesAKinectsFrames) {
  config_.driver.source.kind = FrameSourceKind::kKinectChannel;
  StereoDriverService service(config_, bus_, bus_);
  bus_.Publish("KINECT_FRAME",
               images::RgbdImage{{{5}, "", pair_.left.bgr},
                                 {{5}, "", cv::Mat(240, 320, CV_16UC1, cv::Scalar(2000))}});
  test::HandleAll(bus_);
  ASSERT_EQ(received_.size(), 1u);
  ExpectThePlane(received_[0]);
  EXPECT_EQ(received_[0].left.time.microseconds, 5);
}

TEST_F(StereoDriverServiceTest, RegistersAKinectsDepthThatIsNot) {
  config_.driver.source.kind = FrameSourceKind::kKinectChannel;
  RegistrationConfig& registration = config_.driver.depth_camera.registration;
  registration.mode = RegistrationMode::kExtrinsics;
  registration.intrinsics = folder_.Write("cd_in.yml", ColourAndDepthIntrinsics()).string();
  registration.extrinsics = folder_.Write("cd_ex.yml", ColourAndDepthExtrinsics()).string();
  StereoDriverService service(config_, bus_, bus_);
  const DepthScene scene = {{Eigen::Vector3d::UnitZ(), 2.0}, {}};
  images::RgbdImage image{{{5}, "", pair_.left.bgr},
                          {{5}, "", MeasureDepth(DepthBesideColour(), scene)},
                          /*is_registered=*/false};
  bus_.Publish("KINECT_FRAME", image);
  test::HandleAll(bus_);
  ASSERT_EQ(received_.size(), 1u);
  EXPECT_NEAR(received_[0].depth_mm.at<std::uint16_t>(60, 30), 2000, 1);
  EXPECT_NEAR(received_[0].depth_mm.at<std::uint16_t>(60, 120), 2000, 1);
  EXPECT_FALSE(service.health().is_degraded);
  image.is_registered = true;
  bus_.Publish("KINECT_FRAME", image);
  test::HandleAll(bus_);
  EXPECT_TRUE(service.health().is_degraded);
  EXPECT_THAT(service.health().text, HasSubstr("mode to sensor"));
}

TEST_F(StereoDriverServiceTest, SaysOnceThatAKinectsDepthIsNotRegisteredAndTheCure) {
  config_.driver.source.kind = FrameSourceKind::kKinectChannel;
  StereoDriverService service(config_, bus_, bus_);
  const images::RgbdImage image{{{5}, "", pair_.left.bgr},
                                {{5}, "", cv::Mat(240, 320, CV_16UC1, cv::Scalar(2000))},
                                /*is_registered=*/false};
  testing::internal::CaptureStderr();
  for (int i = 0; i < 3; ++i) {
    bus_.Publish("KINECT_FRAME", image);
    test::HandleAll(bus_);
    service.Step();
  }
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_EQ(received_.size(), 3u);
  EXPECT_THAT(service.health().text, HasSubstr("registration.mode to extrinsics"));
  const auto line = log.find("not registered to the colour picture");
  ASSERT_NE(line, std::string::npos) << log;
  EXPECT_EQ(log.find("not registered to the colour picture", line + 1), std::string::npos) << log;
}

TEST_F(StereoDriverServiceTest, TakesColourDepthAndLensOfADimosRobot) {
  config_.driver.source.kind = FrameSourceKind::kDimos;
  StereoDriverService service(config_, bus_, bus_);
  geometry::CameraCalibration lens = geometry::GuessCalibration(320, 240, 1.3);
  lens.time = {5'000};
  lens.is_calibrated = true;
  std::optional<geometry::StereoCalibration> calibration;
  bus_.Subscribe<geometry::StereoCalibration>(
      "STEREO_CALIBRATION", transport::Delivery::kEvery,
      [&calibration](const geometry::StereoCalibration& said) { calibration = said; });
  bus_.Publish("/camera_info#sensor_msgs.CameraInfo", lens);
  bus_.Publish("/color_image#sensor_msgs.Image", images::Image{{5'000}, "", pair_.left.bgr});
  bus_.Publish("/depth_image#sensor_msgs.Image",
               images::DepthImage{{9'000}, "", cv::Mat(240, 320, CV_16UC1, cv::Scalar(2000))});
  test::HandleAll(bus_);
  service.Step();
  test::HandleAll(bus_);
  ASSERT_EQ(received_.size(), 1u);
  ExpectThePlane(received_[0]);
  EXPECT_EQ(received_[0].left.time.microseconds, 5'000);
  ASSERT_TRUE(calibration);
  EXPECT_EQ(calibration->rectified.focal_px, lens.focal_px);
  EXPECT_TRUE(calibration->rectified.is_calibrated);
}

TEST_F(StereoDriverServiceTest, HoldsFramesOfADimosRobotBackThatComeBeforeItsLens) {
  config_.driver.source.kind = FrameSourceKind::kDimos;
  StereoDriverService service(config_, bus_, bus_);
  std::vector<geometry::StereoCalibration> calibrations;
  bus_.Subscribe<geometry::StereoCalibration>(
      "STEREO_CALIBRATION", transport::Delivery::kEvery,
      [&calibrations](const auto& said) { calibrations.push_back(said); });
  const auto send = [&](std::int64_t time_us) {
    bus_.Publish("/color_image#sensor_msgs.Image", images::Image{{time_us}, "", pair_.left.bgr});
    bus_.Publish("/depth_image#sensor_msgs.Image",
                 images::DepthImage{{time_us}, "", cv::Mat(240, 320, CV_16UC1, cv::Scalar(2000))});
    test::HandleAll(bus_);
    service.Step();
    test::HandleAll(bus_);
  };
  send(100'000);
  EXPECT_TRUE(received_.empty());
  EXPECT_THAT(service.health().text, HasSubstr("1 skipped pictures"));
  geometry::CameraCalibration lens = geometry::GuessCalibration(320, 240, 1.3);
  lens.is_calibrated = true;
  bus_.Publish("/camera_info#sensor_msgs.CameraInfo", lens);
  send(200'000);
  ASSERT_EQ(calibrations.size(), 1u);
  EXPECT_TRUE(calibrations[0].rectified.is_calibrated);
  EXPECT_EQ(received_.size(), 1u);
}

TEST_F(StereoDriverServiceTest, FollowsTheColourCameraOfADimosRobot) {
  config_.driver.source.kind = FrameSourceKind::kDimos;
  config_.driver.depth_camera.calibration.mount.parent_frame = "base_link";
  StereoDriverService service(config_, bus_, bus_);
  std::vector<geometry::CameraPose> poses;
  bus_.Subscribe<geometry::CameraPose>("CAMERA_POSE", transport::Delivery::kEvery,
                                       [&poses](const auto& pose) { poses.push_back(pose); });
  bus_.Publish("/depth_image#sensor_msgs.Image",
               images::DepthImage{{5'000}, "depth", cv::Mat(240, 320, CV_16UC1)});
  bus_.Publish("/color_image#sensor_msgs.Image", images::Image{{5'000}, "colour", pair_.left.bgr});
  test::HandleAll(bus_);
  const geometry::RigidTransform base_from_colour{Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5),
                                                  {0.0, 0.0, 1.0}};
  bus_.Publish("/tf#tf2_msgs.TFMessage",
               geometry::FrameTransforms{{{6'000}, "base_link", "depth", {}},
                                         {{4'000}, "base_link", "colour", base_from_colour}});
  test::HandleAll(bus_);
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_EQ(poses[0].time.microseconds, 4'000);
  EXPECT_EQ(poses[0].parent_from_camera.translation_m, Eigen::Vector3d(0.0, 0.0, 1.0));
  EXPECT_THAT(service.health().text, testing::Not(HasSubstr("transform")));
}

TEST_F(StereoDriverServiceTest, CountsADimosRobotsFramesThatCannotBeUsedAndGoesOn) {
  config_.driver.source.kind = FrameSourceKind::kDimos;
  const std::string lens = IntrinsicsText(SyntheticRig()) + "image_width: 320\nimage_height: 240\n";
  config_.driver.depth_camera.calibration.file = folder_.Write("lens.yml", lens).string();
  StereoDriverService service(config_, bus_, bus_);
  const auto send = [&](std::int64_t time_us, cv::Size colour, cv::Size depth) {
    bus_.Publish("/color_image#sensor_msgs.Image",
                 images::Image{{time_us}, "", cv::Mat(colour, CV_8UC3, cv::Scalar(1, 2, 3))});
    bus_.Publish("/depth_image#sensor_msgs.Image",
                 images::DepthImage{{time_us}, "", cv::Mat(depth, CV_16UC1, cv::Scalar(2000))});
    test::HandleAll(bus_);
    service.Step();
    test::HandleAll(bus_);
  };
  send(100'000, {320, 120}, {320, 120});  // Not what the lens file is for.
  send(200'000, {320, 240}, {320, 120});  // Two views.
  EXPECT_TRUE(received_.empty());
  EXPECT_THAT(DropsOn("/depth_image#sensor_msgs.Image"), IsEmpty());
  EXPECT_THAT(service.health().text, HasSubstr("2 pictures that make no pair"));
  EXPECT_TRUE(service.health().is_degraded);
  send(300'000, {320, 240}, {320, 240});
  EXPECT_EQ(received_.size(), 1u);
}

TEST_F(StereoDriverServiceTest, PublishesCalibrationThenPairThenDepth) {
  UseFolders(FrameSourceKind::kTwoCameras);
  Write("left.png", pair_.left.bgr);
  Write("right.png", pair_.right.bgr);
  config_.publishes_pairs = true;
  std::vector<std::string> order;
  bus_.SubscribeRaw("STEREO.*", [&order](const transport::RawMessage& message) {
    order.push_back(message.channel);
  });
  RunToTheEnd();
  EXPECT_THAT(order, ElementsAre("STEREO_CALIBRATION", "STEREO_PAIR", "STEREO"));
}

TEST_F(StereoDriverServiceTest, CountsPairsThatItsCalibrationDoesNotSuitAndGoesOn) {
  config_.driver.source.kind = FrameSourceKind::kPairChannel;
  config_.driver.calibration.width_px = 320;
  config_.driver.calibration.height_px = 240;
  StereoDriverService service(config_, bus_, bus_);
  images::StereoPair wide = pair_;
  wide.left.bgr = wide.right.bgr = cv::Mat(120, 320, CV_8UC3, cv::Scalar(0, 0, 0));
  bus_.Publish("STEREO_PAIR", wide);
  test::HandleAll(bus_);
  EXPECT_TRUE(service.health().is_degraded);
  EXPECT_THAT(service.health().text, HasSubstr("1 pictures that make no pair: "));
  EXPECT_THAT(service.health().text, HasSubstr("another aspect"));
  bus_.Publish("STEREO_PAIR", pair_);
  test::HandleAll(bus_);
  EXPECT_FALSE(service.health().is_degraded);
  EXPECT_THAT(DropsOn("STEREO_PAIR"), IsEmpty());
  EXPECT_EQ(received_.size(), 1u);
}

TEST_F(StereoDriverServiceTest, PlaysARecordingOnBehindPairsThatItsCalibrationDoesNotSuit) {
  config_.driver.calibration.width_px = 320;
  config_.driver.calibration.height_px = 240;
  UseFolders(FrameSourceKind::kTwoCameras);
  const cv::Mat wide(120, 320, CV_8UC3, cv::Scalar(0, 0, 0));
  for (const char* side : {"left", "right"}) {
    Write(side + std::string("1.png"), pair_.left.bgr);
    Write(side + std::string("2.png"), wide);
    Write(side + std::string("3.png"), pair_.left.bgr);
  }
  RunToTheEnd();
  EXPECT_EQ(received_.size(), 2u);
}

TEST_F(StereoDriverServiceTest, SaysWhenNothingOfARecordingBelongsTogether) {
  UseFolders(FrameSourceKind::kTwoCameras);
  Write("left.png", pair_.left.bgr);
  Write("right.png", cv::Mat(10, 10, CV_8UC3, cv::Scalar(0, 0, 0)));
  EXPECT_THAT([&] { RunToTheEnd(); },
              testing::ThrowsMessage<config::ConfigError>(HasSubstr("do they belong together")));
}

TEST_F(StereoDriverServiceTest, NamesColourAndDepthAndOneSourceAsWhatTheyAre) {
  UseFolders(FrameSourceKind::kColourAndDepth);
  Write("left1.png", pair_.left.bgr);
  Write("right1.png", cv::Mat(pair_.left.bgr.size(), CV_16UC1, cv::Scalar(1500)));
  Write("right2.png", cv::Mat(pair_.left.bgr.size(), CV_16UC1, cv::Scalar(1500)));
  Write("right3.png", cv::Mat(pair_.left.bgr.size(), CV_16UC1, cv::Scalar(1500)));
  StereoDriverService service(config_, bus_, bus_);
  while (service.Step() != program::StepResult::kFinished) {
  }
  EXPECT_THAT(service.health().text, HasSubstr("depth pictures without a colour one"));
  Write("left1.png", cv::Mat(10, 21, CV_8UC3, cv::Scalar(0, 0, 0)));
  UseFolders(FrameSourceKind::kSideBySide);
  EXPECT_THAT([&] { RunToTheEnd(); }, testing::ThrowsMessage<config::ConfigError>(
                                          testing::AllOf(HasSubstr("no frame of source.left '"),
                                                         testing::Not(HasSubstr("source.right")))));
}

TEST_F(StereoDriverServiceTest, SaysHowManyPicturesHadNoPartner) {
  UseFolders(FrameSourceKind::kTwoCameras);
  Write("left1.png", pair_.left.bgr);
  Write("left2.png", pair_.left.bgr);
  Write("right1.png", pair_.right.bgr);
  StereoDriverService service(config_, bus_, bus_);
  while (service.Step() != program::StepResult::kFinished) {
  }
  EXPECT_THAT(service.health().text, HasSubstr("1 left pictures without a right one"));
}

class PeopleServiceTest : public StereoDriverServiceTest {
 protected:
  PeopleServiceTest() {
    config_.driver.source.kind = FrameSourceKind::kPairChannel;
    config_.driver.matcher.match_size = MatchSize::kPeople;
    // A plane slanted a little: at full size its distances are others.
    Plane slanted;
    slanted.normal = Eigen::Vector3d(0.35, 0.2, 1.0).normalized();
    pair_ = Photograph(SyntheticRig(), slanted);
    body_model::LimbPose limb;
    limb.proximal_m = {0.0, -0.2, 2.0};
    limb.distal_m = {0.0, 0.2, 2.0};
    limb.state = body_model::LimbState::kMeasured;
    body_model::TrackedBody body;
    body.model_id = 1;
    body.limbs = {limb};
    poses_.camera = poses_.frame = "STEREO";
    poses_.bodies = {body};
  }
  /// The depth of the pair after what was said before.
  cv::Mat DepthAfter(const std::vector<body_model::BodyPoses>& said) {
    transport::Bus bus(test::Memory());
    std::vector<images::StereoImage> received;
    bus.Subscribe<images::StereoImage>(
        "STEREO", transport::Delivery::kEvery,
        [&](const images::StereoImage& stereo) { received.push_back(stereo); });
    StereoDriverService service(config_, bus, bus);
    for (const auto& poses : said) bus.Publish("BODY_POSES", poses);
    test::HandleAll(bus);
    bus.Publish("STEREO_PAIR", pair_);
    test::HandleAll(bus);
    health_ = service.health();
    return received.empty() ? cv::Mat() : received[0].depth_mm;
  }
  int DifferencesTo(const cv::Mat& depth_mm, const std::vector<body_model::BodyPoses>& said) {
    return cv::countNonZero(DepthAfter(said) != depth_mm);
  }

  body_model::BodyPoses poses_;
  transport::Health health_;
};

TEST_F(PeopleServiceTest, MeasuresAtFullSizeWherePosesSayThatSomebodyIs) {
  const cv::Mat nobody = DepthAfter({});
  ASSERT_EQ(nobody.size(), cv::Size(160, 120));
  EXPECT_GT(DifferencesTo(nobody, {poses_}), 100);
  EXPECT_EQ(DifferencesTo(DepthAfter({poses_}), {poses_}), 0) << "same in, same out";
}

TEST_F(PeopleServiceTest, IsBackAtHalfSizeWhenTheyHaveLeft) {
  const cv::Mat nobody = DepthAfter({});
  body_model::BodyPoses left = poses_;
  left.bodies.clear();
  EXPECT_EQ(DifferencesTo(nobody, {poses_, left}), 0);
}

TEST_F(PeopleServiceTest, CountsPosesOfAnotherPictureAndDoesNotFollowThem) {
  const cv::Mat nobody = DepthAfter({});
  body_model::BodyPoses other = poses_;
  other.camera = "CAMERA";
  EXPECT_EQ(DifferencesTo(nobody, {other}), 0);
  EXPECT_THAT(health_.text, HasSubstr("1 poses of another picture or frame"));
  EXPECT_FALSE(health_.is_degraded);
}

TEST_F(PeopleServiceTest, HearsNobodyWithoutAChannelOrAtHalfSize) {
  const cv::Mat nobody = DepthAfter({});
  config_.poses_channel = "";
  config_.Validate();
  EXPECT_EQ(DifferencesTo(nobody, {poses_}), 0);
  config_.poses_channel = "BODY_POSES";
  config_.driver.matcher.match_size = MatchSize::kHalf;
  EXPECT_EQ(DifferencesTo(nobody, {poses_}), 0);
}

TEST_F(PeopleServiceTest, WritesALogToWhichNobodySaysWherePeopleAre) {
  UseFolders(FrameSourceKind::kTwoCameras);
  Write("left1.png", pair_.left.bgr);
  Write("right1.png", pair_.right.bgr);
  transport::BusOptions options;
  options.url = "file://" + (folder_.path() / "depth.lcmlog").string() + "?mode=w";
  transport::Bus bus(options);
  StereoDriverService service(config_, bus, bus);
  while (service.Step() != program::StepResult::kFinished) {
  }
  EXPECT_FALSE(service.health().is_degraded);
}

TEST(StereoDriverServiceConfig, DoesNotSendPairsToItself) {
  StereoDriverServiceConfig config;
  config.driver.source.kind = FrameSourceKind::kPairChannel;
  config.publishes_pairs = true;
  EXPECT_THROW(config.Validate(), config::ConfigError);
}

}  // namespace
}  // namespace deixis::stereo_driver
