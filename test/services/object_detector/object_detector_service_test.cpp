#include "services/object_detector/object_detector_service.h"

#include <gmock/gmock.h>

#include "common/messages/image.h"
#include "common/messages/objects.h"
#include "test/support/memory_bus.h"
#include "test/support/temporary_folder.h"

namespace deixis::object_detector {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ObjectDetectorServiceTest : public testing::Test {
 protected:
  ObjectDetectorServiceTest() {
    bus_.Subscribe<scene::Objects>(
        "OBJECTS", transport::Delivery::kEvery,
        [this](const scene::Objects& objects) { answers_.push_back(objects); });
  }
  static images::Image Wall(std::int64_t time_us) {
    return {{time_us}, "CAMERA", cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(90))};
  }
  transport::Bus bus_{test::Memory()};
  ObjectDetectorServiceConfig config_;
  std::vector<scene::Objects> answers_;
};

TEST_F(ObjectDetectorServiceTest, AnswersAPictureWithWhatIsKnownAtItsTime) {
  ObjectDetectorService service(config_, bus_, bus_);
  bus_.Publish("CAMERA", Wall(77));
  test::HandleAll(bus_);
  ASSERT_EQ(answers_.size(), 1u);
  EXPECT_EQ(answers_[0].time.microseconds, 77);
  EXPECT_EQ(answers_[0].camera, "CAMERA");
  EXPECT_TRUE(answers_[0].objects.empty());
}

TEST_F(ObjectDetectorServiceTest, AnswersEveryPictureWhenTimeJumpsToAndFro) {
  ObjectDetectorService service(config_, bus_, bus_);
  const std::int64_t last_us = std::int64_t{1} << 60;  // The year 38,500.
  std::vector<std::int64_t> answered;
  for (const std::int64_t time_us :
       {std::int64_t{9'000'000'000}, std::int64_t{5}, last_us, std::int64_t{6}, last_us - 1}) {
    bus_.Publish("CAMERA", Wall(time_us));
    test::HandleAll(bus_);
    ASSERT_FALSE(answers_.empty());
    EXPECT_EQ(answers_.back().time.microseconds, time_us);
  }
  EXPECT_EQ(answers_.size(), 5u);
  EXPECT_THAT(bus_.trouble(), HasSubstr("the time on CAMERA jumped"));
}

TEST_F(ObjectDetectorServiceTest, GoesOnAfterAMessageThatIsNoPicture) {
  ObjectDetectorService service(config_, bus_, bus_);
  const std::vector<std::uint8_t> junk(40, 0xAB);
  bus_.PublishRaw("CAMERA", {junk.data(), junk.size()}, {1});
  test::HandleAll(bus_);
  bus_.Publish("CAMERA", Wall(78));
  test::HandleAll(bus_);
  ASSERT_EQ(answers_.size(), 1u);
  EXPECT_EQ(answers_[0].time.microseconds, 78);
}

TEST_F(ObjectDetectorServiceTest, DoesNotStartWithoutItsCascade) {
  config_.detectors.cascades.trained[0].file = "missing.xml";
  EXPECT_THROW(ObjectDetectorService(config_, bus_, bus_), config::ConfigError);
}

TEST_F(ObjectDetectorServiceTest, WarnsOfAPlacesFileWithoutPlaces) {
  const test::TemporaryFolder folder;
  config_.detectors.places.file = folder.Write("places.yaml", "").string();
  testing::internal::CaptureStderr();
  ObjectDetectorService service(config_, bus_, bus_);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("no places are known"));
}

TEST_F(ObjectDetectorServiceTest, RefusesToPublishOnItsInput) {
  config_.objects_channel = config_.image_channel;
  EXPECT_THAT([this] { config_.Validate(); },
              testing::ThrowsMessage<config::ConfigError>(
                  HasSubstr("'objects_channel' must be another channel than image_channel")));
}

TEST_F(ObjectDetectorServiceTest, NamesEveryFaultOfItsConfiguration) {
  config_.image_channel = "";
  config_.detectors.cascades.tracking.memory_s = -1.0;
  EXPECT_THAT([this] { config_.Validate(); },
              testing::ThrowsMessage<config::ConfigError>(testing::AllOf(
                  HasSubstr("image_channel"), HasSubstr("cascades.tracking.memory_s"))));
}

}  // namespace
}  // namespace deixis::object_detector
