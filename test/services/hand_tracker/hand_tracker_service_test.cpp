#include "services/hand_tracker/hand_tracker_service.h"

#include <gmock/gmock.h>

#include "common/messages/hands.h"
#include "common/messages/image.h"
#include "common/messages/objects.h"
#include "test/services/hand_tracker/core/synthetic_person.h"
#include "test/support/memory_bus.h"

namespace deixis::hand_tracker {
namespace {

class HandTrackerServiceTest : public testing::Test {
 protected:
  HandTrackerServiceTest() {
    bus_.Subscribe<scene::Hands>("HAND_TRACKS", transport::Delivery::kEvery,
                                 [this](const scene::Hands& hands) { answers_.push_back(hands); });
  }
  void Show(int frame) {
    bus_.Publish("OBJECTS", person_.Faces(frame));
    bus_.Publish("CAMERA", person_.Picture(frame));
    test::HandleAll(bus_);
  }

  SyntheticPerson person_;
  transport::Bus bus_{test::Memory()};
  HandTrackerServiceConfig config_;
  std::vector<scene::Hands> answers_;
};

TEST_F(HandTrackerServiceTest, AnswersEveryPictureAtItsTime) {
  HandTrackerService service(config_, bus_, bus_);
  for (int frame = 0; frame < 3; ++frame) Show(frame);
  ASSERT_EQ(answers_.size(), 3U);
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_EQ(answers_[static_cast<std::size_t>(frame)].time, SyntheticPerson::Time(frame));
    EXPECT_EQ(answers_[static_cast<std::size_t>(frame)].camera, "CAMERA");
  }
}

TEST_F(HandTrackerServiceTest, TellsTheHandsOfAPersonWhoWaves) {
  HandTrackerService service(config_, bus_, bus_);
  for (int frame = 0; frame < 120; ++frame) Show(frame);
  ASSERT_EQ(answers_.back().hands.size(), 2U);
  for (const scene::Hand& hand : answers_.back().hands) EXPECT_EQ(hand.person_id, 7);
}

TEST_F(HandTrackerServiceTest, GoesOnAfterAMessageThatIsNoPicture) {
  HandTrackerService service(config_, bus_, bus_);
  const std::vector<std::uint8_t> junk(40, 0xAB);
  bus_.PublishRaw("CAMERA", {junk.data(), junk.size()}, {1});
  bus_.PublishRaw("OBJECTS", {junk.data(), junk.size()}, {1});
  test::HandleAll(bus_);
  EXPECT_TRUE(answers_.empty());
  Show(0);
  EXPECT_EQ(answers_.size(), 1U);
}

TEST_F(HandTrackerServiceTest, FollowsHandsAgainAfterTimeHasJumpedToAndFro) {
  HandTrackerService service(config_, bus_, bus_);
  const auto show_at = [this](int frame, std::int64_t offset_us) {
    auto faces = person_.Faces(frame);
    auto picture = person_.Picture(frame);
    faces.time.microseconds += offset_us;
    for (scene::Object& face : faces.objects) face.last_seen = faces.time;
    picture.time.microseconds += offset_us;
    bus_.Publish("OBJECTS", faces);
    bus_.Publish("CAMERA", picture);
    test::HandleAll(bus_);
  };
  constexpr std::int64_t kHour_us = 3'600'000'000;
  constexpr std::int64_t kLast_us = (std::int64_t{1} << 60) - 1'000'000'000;  // The year 38,500.
  int frame = 0;
  for (const std::int64_t offset_us : {9 * kHour_us, std::int64_t{0}, kLast_us, 2 * kHour_us}) {
    for (int i = 0; i < 5; ++i, ++frame) show_at(frame, offset_us);
  }
  EXPECT_EQ(answers_.size(), 20U);
  for (int i = 0; i < 120; ++i, ++frame) show_at(frame, 2 * kHour_us);
  EXPECT_EQ(answers_.back().hands.size(), 2U);
  EXPECT_THAT(bus_.trouble(), testing::HasSubstr("the time on CAMERA jumped"));
}

TEST_F(HandTrackerServiceTest, PublishesWhereTheConfigurationSays) {
  config_.hands_channel = "ELSEWHERE";
  int elsewhere = 0;
  bus_.Subscribe<scene::Hands>("ELSEWHERE", transport::Delivery::kEvery,
                               [&elsewhere](const scene::Hands&) { ++elsewhere; });
  HandTrackerService service(config_, bus_, bus_);
  Show(0);
  EXPECT_EQ(elsewhere, 1);
  EXPECT_TRUE(answers_.empty());
}

TEST(HandTrackerServiceConfig, RefusesToPublishOnAnInput) {
  HandTrackerServiceConfig config;
  EXPECT_NO_THROW(config.Validate());
  config.hands_channel = config.image_channel;
  EXPECT_THROW(config.Validate(), config::ConfigError);
}

TEST(HandTrackerServiceConfig, RefusesNonsenseAndNamesTheKey) {
  HandTrackerServiceConfig config;
  EXPECT_NO_THROW(config.tracker.Validate());
  config.tracker.low_threshold = 300;
  try {
    config.tracker.Validate();
    FAIL() << "was accepted";
  } catch (const config::ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("low_threshold"), std::string::npos);
  }
}

}  // namespace
}  // namespace deixis::hand_tracker
