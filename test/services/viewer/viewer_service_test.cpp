#include "services/viewer/viewer_service.h"

#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "common/messages/body_poses.h"
#include "common/messages/gesture.h"
#include "common/messages/hands.h"
#include "common/messages/image.h"
#include "common/messages/person_model.h"
#include "common/messages/stereo_calibration.h"
#include "test/support/memory_bus.h"
#include "test/support/temporary_folder.h"

namespace deixis::viewer {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

class ViewerServiceTest : public testing::Test {
 protected:
  ViewerServiceTest() { config_.save_folder = folder_.path().string(); }
  void SendImage(std::int64_t time_us) {
    bus_.Publish("CAMERA", images::Image{{time_us}, "CAMERA", cv::Mat::zeros(48, 64, CV_8UC3)});
    test::HandleAll(bus_);
  }
  void SendGesture(std::int64_t event_id, std::int64_t time_us, std::int64_t end_us) {
    scene::Gesture gesture;
    gesture.time = {time_us};
    gesture.event_id = event_id;
    gesture.name = "pointing";
    gesture.end = {end_us};
    gesture.outcome = scene::GestureOutcome::kObject;
    gesture.object_id = 2;
    gesture.object_label = "lamp";
    bus_.Publish("GESTURES", gesture);
    test::HandleAll(bus_);
  }
  bool Exists(const std::string& name) const {
    return std::filesystem::exists(folder_.path() / name);
  }
  test::TemporaryFolder folder_;
  ViewerServiceConfig config_;
  transport::Bus bus_{test::Memory()};
};

TEST_F(ViewerServiceTest, WritesTheLatestPicture) {
  ViewerService service(config_, bus_, bus_);
  SendImage(1'000'000);
  EXPECT_TRUE(Exists("latest.png"));
}

TEST_F(ViewerServiceTest, WritesTheLatestPictureNoMoreOftenThanAsked) {
  ViewerService service(config_, bus_, bus_);
  SendImage(1'000'000);
  std::filesystem::remove(folder_.path() / "latest.png");
  SendImage(1'900'000);
  EXPECT_FALSE(Exists("latest.png"));
  SendImage(2'000'000);
  EXPECT_TRUE(Exists("latest.png"));
}

TEST_F(ViewerServiceTest, GoesOnWhenTimeJumpsToAndFro) {
  ViewerService service(config_, bus_, bus_);
  const std::int64_t last_us = std::int64_t{1} << 60;  // The year 38,500.
  for (const std::int64_t time_us :
       {std::int64_t{9'000'000'000}, std::int64_t{5}, last_us, std::int64_t{7'000'000}}) {
    SendImage(time_us);
    EXPECT_TRUE(std::filesystem::remove(folder_.path() / "latest.png")) << time_us;
  }
  SendGesture(1, 7'000'000, 0);
  EXPECT_TRUE(Exists("gesture_1_lamp_7000000.png"));
}

TEST_F(ViewerServiceTest, WritesOnePicturePerGesture) {
  ViewerService service(config_, bus_, bus_);
  SendImage(1'000'000);
  SendGesture(1, 1'000'000, 0);
  EXPECT_TRUE(Exists("gesture_1_lamp_1000000.png"));
  SendImage(1'100'000);
  SendGesture(1, 1'100'000, 1'090'000);  // The same gesture has ended.
  EXPECT_FALSE(Exists("gesture_1_lamp_1100000.png"));
}

TEST_F(ViewerServiceTest, WaitsForThePictureOfAGesture) {
  ViewerService service(config_, bus_, bus_);
  SendImage(1'000'000);
  SendGesture(1, 1'066'667, 0);
  EXPECT_FALSE(Exists("gesture_1_lamp_1066667.png"));
  SendImage(1'066'667);
  ASSERT_TRUE(Exists("gesture_1_lamp_1066667.png"));
  const cv::Mat picture = cv::imread((folder_.path() / "gesture_1_lamp_1066667.png").string());
  EXPECT_GT(cv::countNonZero(picture.reshape(1)), 0) << "the decision is written into it";
}

TEST_F(ViewerServiceTest, KnowsTheEndOfAGestureAfterAnotherHasBegun) {
  ViewerService service(config_, bus_, bus_);
  SendImage(1'000'000);
  SendGesture(1, 1'000'000, 0);
  SendGesture(2, 1'000'000, 0);
  SendImage(1'100'000);
  SendGesture(1, 1'100'000, 1'090'000);
  EXPECT_TRUE(Exists("gesture_2_lamp_1000000.png"));
  EXPECT_FALSE(Exists("gesture_1_lamp_1100000.png"));
}

TEST_F(ViewerServiceTest, SaysWhilePicturesCannotBeWritten) {
  ViewerService service(config_, bus_, bus_);
  std::filesystem::create_directories(folder_.path() / "latest.png" / "occupied");
  SendImage(1'000'000);
  EXPECT_TRUE(service.health().is_degraded);
  EXPECT_THAT(service.health().text, HasSubstr("latest.png"));
  std::filesystem::remove_all(folder_.path() / "latest.png");
  SendImage(2'000'000);
  EXPECT_FALSE(service.health().is_degraded);
}

TEST_F(ViewerServiceTest, GoesOnWithoutThePictureOfAGesture) {
  ViewerService service(config_, bus_, bus_);
  SendGesture(1, 1'000'000, 0);
  EXPECT_EQ(service.health().text, "");
  SendImage(2'000'000);
  EXPECT_TRUE(Exists("latest.png"));
  EXPECT_EQ(service.health().text, "1 gestures without a picture");
  EXPECT_FALSE(service.health().is_degraded);
}

TEST_F(ViewerServiceTest, CountsGesturesThatAreTooManyToWait) {
  ViewerService service(config_, bus_, bus_);
  for (std::int64_t i = 1; i <= 18; ++i) SendGesture(i, 1'000'000 * i, 0);
  EXPECT_EQ(service.health().text, "2 gestures without a picture");
}

TEST_F(ViewerServiceTest, SaysTheCureWhenThereIsNoDisplay) {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  config_.window = true;
  EXPECT_THAT([this] { ViewerService service(config_, bus_, bus_); },
              ThrowsMessage<config::ConfigError>(HasSubstr("no display")));
}

TEST_F(ViewerServiceTest, DrawsPeopleIntoThePictureOfTheirTime) {
  config_.image_channel = "STEREO";
  ViewerService service(config_, bus_, bus_);
  geometry::StereoCalibration calibration;
  calibration.camera = "STEREO";
  calibration.rectified = geometry::GuessCalibration(64, 48, 1.0);
  calibration.left = calibration.right = calibration.rectified;
  calibration.right_from_left.translation_m = {-0.1, 0.0, 0.0};
  calibration.disparity_sigma_px = 0.3;
  body_model::Limb torso;
  torso.name = "torso";
  torso.shape = {0.2, 0.2, 0.2, 0.2, 0.5};
  const body_model::PersonModel model{{1'000'000}, body_model::BodyModel("torso", {torso})};
  body_model::BodyPoses poses{{1'000'000}, "STEREO", "STEREO", "", {}, {}};
  body_model::TrackedBody& body = poses.bodies.emplace_back();
  body.state = body_model::BodyState::kTracked;
  body.pose = body_model::RestPose(model.body);
  body.pose.frame_from_root.translation_m = {0.0, 0.0, 2.0};
  body.limbs.resize(1);
  body.limbs[0].state = body_model::LimbState::kMeasured;
  body_model::Kinematics kinematics(model.body);
  body_model::PlaceLimbs(kinematics, body);
  bus_.Publish("STEREO_CALIBRATION", calibration);
  bus_.Publish("BODY_MODEL", model);
  bus_.Publish("BODY_POSES", poses);
  bus_.Publish("STEREO", images::Image{{1'000'000}, "STEREO", cv::Mat::zeros(48, 64, CV_8UC3)});
  test::HandleAll(bus_);
  const cv::Mat picture = cv::imread((folder_.path() / "latest.png").string());
  ASSERT_EQ(picture.size(), cv::Size(64, 48));
  EXPECT_NE(picture.at<cv::Vec3b>(26, 32), cv::Vec3b()) << "within the torso";
  EXPECT_EQ(picture.at<cv::Vec3b>(46, 2), cv::Vec3b());
}

TEST_F(ViewerServiceTest, KeepsAPictureFromTimeToTime) {
  config_.stills_period_s = 2.0;
  ViewerService service(config_, bus_, bus_);
  for (const std::int64_t time_us : {1'000'000, 2'000'000, 3'000'000}) SendImage(time_us);
  EXPECT_TRUE(Exists("picture_1000000.png"));
  EXPECT_FALSE(Exists("picture_2000000.png"));
  EXPECT_TRUE(Exists("picture_3000000.png"));
}

TEST_F(ViewerServiceTest, FilmsEveryPicture) {
  config_.film = (folder_.path() / "film.mp4").string();
  config_.film_rate_hz = 10.0;
  {
    ViewerService service(config_, bus_, bus_);
    for (std::int64_t i = 1; i <= 20; ++i) SendImage(100'000 * i);
    EXPECT_FALSE(service.health().is_degraded) << service.health().text;
  }
  cv::VideoCapture film(config_.film);
  EXPECT_EQ(film.get(cv::CAP_PROP_FPS), 10.0);
  int pictures = 0;
  for (cv::Mat picture; film.read(picture); ++pictures) {
    ASSERT_EQ(picture.size(), cv::Size(64, 48));
  }
  EXPECT_EQ(pictures, 20);
}

TEST_F(ViewerServiceTest, SaysWhenAPictureDoesNotFitIntoTheFilm) {
  config_.film = (folder_.path() / "film.mp4").string();
  ViewerService service(config_, bus_, bus_);
  SendImage(1'000'000);
  bus_.Publish("CAMERA", images::Image{{2'100'000}, "CAMERA", cv::Mat::zeros(96, 128, CV_8UC3)});
  test::HandleAll(bus_);
  EXPECT_TRUE(service.health().is_degraded);
  EXPECT_THAT(service.health().text, HasSubstr("another size"));
}

TEST_F(ViewerServiceTest, RefusesAFilmThatCannotBeMade) {
  config_.film = (folder_.path() / "nowhere" / "film.mp4").string();
  EXPECT_THAT([this] { ViewerService service(config_, bus_, bus_); },
              ThrowsMessage<config::ConfigError>(HasSubstr("film")));
}

TEST_F(ViewerServiceTest, NamesEveryFaultOfItsConfiguration) {
  config_.hands_channel = "";
  config_.history.max_images = 0;
  EXPECT_THAT([this] { config_.Validate(); },
              ThrowsMessage<config::ConfigError>(
                  testing::AllOf(HasSubstr("hands_channel"), HasSubstr("history.max_images"))));
}

}  // namespace
}  // namespace deixis::viewer
