#include "services/gesture_recogniser/gesture_recogniser_service.h"

#include <gmock/gmock.h>

#include "common/messages/camera_calibration.h"
#include "common/messages/gesture.h"
#include "common/messages/gesture_state.h"
#include "common/messages/hands.h"
#include "common/messages/objects.h"
#include "test/services/gesture_recogniser/gesture_scene.h"
#include "test/support/memory_bus.h"
#include "test/support/temporary_folder.h"

namespace deixis::gesture_recogniser {
namespace {

class GestureRecogniserServiceTest : public testing::Test {
 protected:
  GestureRecogniserServiceTest() {
    std::filesystem::create_directories(folder_.path() / "gestures");
    for (const GestureModel& model : TestModels()) {
      folder_.Write("gestures/" + model.name + ".yaml", ToYaml(model));
    }
    setenv("DEIXIS_CONFIG_DIR", folder_.path().c_str(), 1);
    bus_.Subscribe<scene::Gesture>(
        "GESTURES", transport::Delivery::kEvery,
        [this](const scene::Gesture& gesture) { gestures_.push_back(gesture); });
    bus_.Subscribe<scene::GestureState>(
        "GESTURE_STATE", transport::Delivery::kEvery,
        [this](const scene::GestureState& state) { states_.push_back(state); });
  }
  test::TemporaryFolder folder_;
  transport::Bus bus_{test::Memory()};
  std::vector<scene::Gesture> gestures_;
  std::vector<scene::GestureState> states_;
};

TEST_F(GestureRecogniserServiceTest, TurnsTracksAndObjectsIntoOneEvent) {
  const GestureRecogniserService service({}, bus_, bus_);
  const PointingScene scene;
  int frames = 0;
  for (double time_s = 0.0; time_s < 4.5; time_s += 1.0 / 15.0, ++frames) {
    bus_.Publish("OBJECTS", scene.Objects(time_s));
    bus_.Publish("HAND_TRACKS", HandAt(time_s, scene.Hand(time_s)));
    test::HandleAll(bus_);
  }
  EXPECT_EQ(states_.size(), static_cast<std::size_t>(frames));
  ASSERT_EQ(gestures_.size(), 2U);  // Its beginning and its end.
  EXPECT_EQ(gestures_[0].object_id, 3);
  EXPECT_EQ(gestures_[0].event_id, gestures_[1].event_id);
  EXPECT_NE(gestures_[1].end.microseconds, 0);
}

TEST_F(GestureRecogniserServiceTest, RecognisesAgainAfterTimeHasJumpedToAndFro) {
  const GestureRecogniserService service({}, bus_, bus_);
  const PointingScene scene;
  const auto play = [&](double from_s, double to_s, std::int64_t offset_us) {
    for (double time_s = from_s; time_s < to_s; time_s += 1.0 / 15.0) {
      auto objects = scene.Objects(time_s);
      auto hands = HandAt(time_s, scene.Hand(time_s));
      objects.time.microseconds += offset_us;
      for (auto& object : objects.objects) object.last_seen = objects.time;
      hands.time.microseconds += offset_us;
      bus_.Publish("OBJECTS", objects);
      bus_.Publish("HAND_TRACKS", hands);
      test::HandleAll(bus_);
    }
  };
  constexpr std::int64_t kHour_us = 3'600'000'000;
  constexpr std::int64_t kLast_us = (std::int64_t{1} << 60) - kHour_us;  // The year 38,500.
  for (const std::int64_t offset_us : {5 * kHour_us, std::int64_t{0}, kLast_us, kHour_us}) {
    play(0.0, 1.0, offset_us);
  }
  gestures_.clear();
  play(0.0, 4.5, 0);
  ASSERT_EQ(gestures_.size(), 2U);
  EXPECT_EQ(gestures_[0].object_id, 3);
}

TEST_F(GestureRecogniserServiceTest, StatesCarryTheTimeOfTheirHands) {
  const GestureRecogniserService service({}, bus_, bus_);
  bus_.Publish("HAND_TRACKS", HandAt(1.25, {100.0, 100.0}));
  test::HandleAll(bus_);
  ASSERT_EQ(states_.size(), 1U);
  EXPECT_EQ(states_[0].time, At(1.25));
  EXPECT_EQ(states_[0].camera, "test");
}

TEST_F(GestureRecogniserServiceTest, WaitsForObjectsAsLongAsNoHandsComeEither) {
  const GestureRecogniserService service({}, bus_, bus_);
  EXPECT_FALSE(service.health().is_degraded);
  EXPECT_EQ(service.health().text, "waiting for the first OBJECTS");
}

TEST_F(GestureRecogniserServiceTest, SaysThatNoObjectsAreKnown) {
  const GestureRecogniserService service({}, bus_, bus_);
  bus_.Publish("HAND_TRACKS", HandAt(0.0, {100.0, 100.0}));
  test::HandleAll(bus_);
  EXPECT_TRUE(service.health().is_degraded);
  EXPECT_THAT(service.health().text, testing::HasSubstr("start object_detector"));
  bus_.Publish("OBJECTS", PointingScene().Objects(0.0));
  test::HandleAll(bus_);
  EXPECT_FALSE(service.health().is_degraded);
  EXPECT_EQ(service.health().text, "");
}

TEST_F(GestureRecogniserServiceTest, NamesThePathOfANestedFault) {
  const auto file = folder_.Write("own.yaml",
                                  "recogniser:\n  segmental:\n    stroke:\n"
                                  "      amplitudes: 1\n");
  EXPECT_THAT([&file] { config::Load<GestureRecogniserServiceConfig>(file); },
              testing::ThrowsMessage<config::ConfigError>(
                  testing::HasSubstr("own.yaml:4: key 'recogniser.segmental.stroke.amplitudes'")));
}

TEST_F(GestureRecogniserServiceTest, RefusesOneChannelForTwoTypes) {
  GestureRecogniserServiceConfig config;
  config.gestures_channel = config.hands_channel;
  EXPECT_THAT([&config] { config.Validate(); },
              testing::ThrowsMessage<config::ConfigError>(testing::HasSubstr(
                  "'gestures_channel' must be another channel than hands_channel")));
}

TEST_F(GestureRecogniserServiceTest, RefusesAModelThatDoesNotExist) {
  GestureRecogniserServiceConfig config;
  config.models = {"no_such_gesture"};
  EXPECT_THROW(GestureRecogniserService(config, bus_, bus_), config::ConfigError);
}

}  // namespace
}  // namespace deixis::gesture_recogniser
