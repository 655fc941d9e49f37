#include "services/gesture_recogniser/core/pointing_recogniser.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "test/services/gesture_recogniser/gesture_scene.h"

namespace deixis::gesture_recogniser {
namespace {

/// Events of a scene of `duration_s`, seen at `rate_hz` in an image that is `zoom` times as large.
std::vector<scene::Gesture> Recognise(const PointingScene& scene, PointingRecogniserConfig config,
                                      double rate_hz = 15.0, double zoom = 1.0) {
  PointingRecogniser recogniser(config, TestModels());
  std::vector<scene::Gesture> events;
  for (double time_s = 0.0; time_s < 5.0; time_s += 1.0 / rate_hz) {
    scene::Objects objects = scene.Objects(time_s);
    for (scene::Object& object : objects.objects) {
      scene::Box& box = *object.box;
      box = {box.x_px * zoom, box.y_px * zoom, box.width_px * zoom, box.height_px * zoom};
    }
    recogniser.ObserveObjects(objects);
    scene::Hands hands = HandAt(time_s, zoom * scene.Hand(time_s));
    hands.hands[0].covariance *= zoom * zoom;
    for (const auto& gesture : recogniser.ObserveHands(hands).gestures) events.push_back(gesture);
  }
  return events;
}

std::vector<scene::Gesture> Begun(const std::vector<scene::Gesture>& events) {
  std::vector<scene::Gesture> begun;
  for (const auto& event : events) {
    if (event.end.microseconds == 0) begun.push_back(event);
  }
  return begun;
}

TEST(PointingRecogniser, NamesTheObjectOnceAndReportsTheEnd) {
  const auto events = Recognise({}, {});
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].outcome, scene::GestureOutcome::kObject);
  EXPECT_EQ(events[0].object_id, 3);
  EXPECT_EQ(events[0].object_label, "object_3");
  EXPECT_EQ(events[0].name, "pointing");
  EXPECT_EQ(events[0].end.microseconds, 0);
  EXPECT_EQ(events[1].event_id, events[0].event_id);
  EXPECT_GT(SecondsBetween(At(3.1), events[1].end), 0.0);
}

TEST(PointingRecogniser, DecidesEarlyInTheHoldAndKnowsTheStart) {
  const auto events = Recognise({}, {});
  ASSERT_FALSE(events.empty());
  EXPECT_GT(SecondsBetween(At(1.5), events[0].time), 0.4);
  EXPECT_LT(SecondsBetween(At(1.5), events[0].time), 1.2);
  EXPECT_NEAR(SecondsBetween(At(1.5), events[0].start), 0.0, 0.3);
}

TEST(PointingRecogniser, HoldsForAnyFrameRate) {
  for (const double rate_hz : {10.0, 24.0, 30.0, 60.0}) {
    const auto begun = Begun(Recognise({}, {}, rate_hz));
    ASSERT_EQ(begun.size(), 1U) << rate_hz;
    EXPECT_EQ(begun[0].object_id, 3) << rate_hz;
  }
}

TEST(PointingRecogniser, HoldsForAnyImageSize) {
  for (const double zoom : {0.5, 2.0, 3.0}) {
    const auto begun = Begun(Recognise({}, {}, 15.0, zoom));
    ASSERT_EQ(begun.size(), 1U) << zoom;
    EXPECT_EQ(begun[0].object_id, 3) << zoom;
  }
}

TEST(PointingRecogniser, StaysSilentWithoutObjects) {
  PointingScene scene;
  scene.objects = {FaceAt({300.0, 90.0})};
  EXPECT_TRUE(Recognise(scene, {}).empty());
}

TEST(PointingRecogniser, StaysSilentWhenTheHandStopsAwayFromObjects) {
  PointingScene scene;
  scene.objects[0] = ObjectAt(3, {620.0, 40.0});
  EXPECT_TRUE(Recognise(scene, {}).empty());
}

TEST(PointingRecogniser, DoesNotTakeTheReturnToRestForPointing) {
  PointingScene scene;
  scene.objects.push_back(ObjectAt(7, scene.rest + Eigen::Vector2d(-40.0, 60.0)));
  const auto begun = Begun(Recognise(scene, {}));
  ASSERT_EQ(begun.size(), 1U);
  EXPECT_EQ(begun[0].object_id, 3);
}

TEST(PointingRecogniser, SaysWhenTwoObjectsAreMeant) {
  PointingScene scene;
  const Eigen::Vector2d beyond = scene.hold + Eigen::Vector2d(46.0, -40.0);
  scene.objects[0] = ObjectAt(3, beyond + Eigen::Vector2d(-7.0, -8.0));
  scene.objects[1] = ObjectAt(4, beyond + Eigen::Vector2d(7.0, 8.0));
  const auto begun = Begun(Recognise(scene, {}));
  ASSERT_EQ(begun.size(), 1U);
  EXPECT_EQ(begun[0].outcome, scene::GestureOutcome::kAmbiguous);
  EXPECT_EQ(begun[0].object_id, -1);
  EXPECT_EQ(begun[0].candidates.size(), 2U);
}

TEST(PointingRecogniser, GivesProbabilitiesThatSumToOne) {
  PointingScene scene;
  PointingRecogniser recogniser({}, TestModels());
  for (double time_s = 0.0; time_s < 4.0; time_s += 1.0 / 15.0) {
    recogniser.ObserveObjects(scene.Objects(time_s));
    for (const auto& hypothesis :
         recogniser.ObserveHands(HandAt(time_s, scene.Hand(time_s))).state.hypotheses) {
      double sum = hypothesis.none_probability;
      for (const auto& candidate : hypothesis.candidates) sum += candidate.probability;
      EXPECT_NEAR(sum, 1.0, 0.03);
    }
  }
}

TEST(PointingRecogniser, StartsAnewWhenTimeJumpsBack) {
  PointingScene scene;
  PointingRecogniser recogniser({}, TestModels());
  for (const double offset_s : {100.0, 0.0}) {
    int begun = 0;
    for (double time_s = 0.0; time_s < 3.0; time_s += 1.0 / 15.0) {
      recogniser.ObserveObjects(scene.Objects(offset_s + time_s));
      const auto hands = HandAt(offset_s + time_s, scene.Hand(time_s));
      begun += static_cast<int>(Begun(recogniser.ObserveHands(hands).gestures).size());
    }
    EXPECT_EQ(begun, 1) << offset_s;
  }
}

/// Events of a hand that points until 2.6 s and is then seen in one more image, at `next_s`.
std::vector<scene::Gesture> EventsAcrossAJump(double next_s) {
  const PointingScene scene;
  PointingRecogniser recogniser({}, TestModels());
  std::vector<scene::Gesture> events;
  for (double time_s = 0.0; time_s < 2.6; time_s += 1.0 / 15.0) {
    recogniser.ObserveObjects(scene.Objects(time_s));
    const auto gestures = recogniser.ObserveHands(HandAt(time_s, scene.Hand(time_s))).gestures;
    events.insert(events.end(), gestures.begin(), gestures.end());
  }
  const auto gestures = recogniser.ObserveHands(HandAt(next_s, scene.hold)).gestures;
  events.insert(events.end(), gestures.begin(), gestures.end());
  return events;
}

TEST(PointingRecogniser, EndsOpenGesturesWhenTimeJumps) {
  for (const double next_s : {4.0, 0.5}) {  // A gap; back.
    const auto events = EventsAcrossAJump(next_s);
    ASSERT_EQ(events.size(), 2U) << next_s;
    EXPECT_EQ(events[1].event_id, events[0].event_id);
    EXPECT_NEAR(SecondsBetween(At(2.6), events[1].end), 0.0, 0.1) << next_s;
  }
}

TEST(PointingRecogniser, ForgetsObjectsThatAreNoLongerReported) {
  PointingRecogniser recogniser({}, TestModels());
  for (int i = 0; i < 100; ++i) {
    scene::Objects objects;
    objects.time = At(i);
    objects.objects = {ObjectAt(i, {100.0, 100.0})};
    recogniser.ObserveObjects(objects);
  }
  EXPECT_EQ(recogniser.remembered_objects(), 11U);  // Of the last 10 s.
}

TEST(PointingRecogniser, RefusesASecondGestureUnlessTheMethodKnowsSeveral) {
  auto models = TestModels();
  models.push_back(models[0]);
  models.back().name = "wave";
  const PointingScene scene;
  PointingRecogniserConfig config;
  EXPECT_THROW(PointingRecogniser(config, models), config::ConfigError);
  config.method = Method::kAsPrinted;
  EXPECT_NO_THROW(PointingRecogniser(config, models));
}

TEST(PointingRecogniser, NeverBeginsBeforeTheFirstTimeThereIs) {
  PointingRecogniserConfig config;
  config.method = Method::kAsPrinted;
  PointingRecogniser recogniser(config, TestModels());
  const PointingScene scene;
  std::vector<scene::Gesture> events;
  for (double time_s = 0.0; time_s < 1.5; time_s += 1.0 / 30.0) {
    const double since_start_s = time_s - SecondsBetween({0}, At(0.0));
    recogniser.ObserveObjects(scene.Objects(since_start_s));
    const auto hands = HandAt(since_start_s, scene.Hand(1.6 + time_s));
    for (const auto& gesture : recogniser.ObserveHands(hands).gestures) events.push_back(gesture);
  }
  ASSERT_FALSE(events.empty());
  EXPECT_LT(events[0].time.microseconds, 600'000);
  EXPECT_EQ(events[0].start.microseconds, 0);
}

TEST(PointingRecogniser, SurvivesHandsThatComeAndGoAndChangeTheirId) {
  PointingScene scene;
  PointingRecogniser recogniser({}, TestModels());
  int frame = 0;
  for (double time_s = 0.0; time_s < 5.0; time_s += 1.0 / 15.0, ++frame) {
    recogniser.ObserveObjects(scene.Objects(time_s));
    scene::Hands hands = HandAt(time_s, scene.Hand(time_s), frame / 20);
    if (frame % 7 == 0) hands.hands.clear();
    for (const auto& hypothesis : recogniser.ObserveHands(hands).state.hypotheses) {
      EXPECT_TRUE(std::isfinite(hypothesis.end_probability));
      EXPECT_TRUE(std::isfinite(hypothesis.none_probability));
    }
  }
}

TEST(PointingRecogniser, FollowsAHandThatIsLostInItsStrokeAndFoundUnderAnotherId) {
  PointingScene scene;
  PointingRecogniser recogniser({}, TestModels());
  std::vector<scene::Gesture> begun;
  for (double time_s = 0.0; time_s < 3.0; time_s += 1.0 / 15.0) {
    recogniser.ObserveObjects(scene.Objects(time_s));
    scene::Hands hands = HandAt(time_s, scene.Hand(time_s), time_s < 1.8 ? 1 : 2);
    if (time_s > 1.65 && time_s < 1.95) hands.hands.clear();
    for (const auto& gesture : Begun(recogniser.ObserveHands(hands).gestures)) {
      begun.push_back(gesture);
    }
  }
  ASSERT_EQ(begun.size(), 1U);
  EXPECT_EQ(begun[0].object_id, 3);
  EXPECT_EQ(begun[0].hand_id, 2);
}

TEST(PointingRecogniser, IgnoresHandsThatAreOnlyPredictedDuringTheHold) {
  PointingScene scene;
  PointingRecogniser recogniser({}, TestModels());
  for (double time_s = 0.0; time_s < 3.0; time_s += 1.0 / 15.0) {
    recogniser.ObserveObjects(scene.Objects(time_s));
    scene::Hands hands = HandAt(time_s, scene.Hand(time_s));
    if (time_s > 1.8) hands.hands[0].state = scene::HandState::kPredicted;
    EXPECT_TRUE(recogniser.ObserveHands(hands).gestures.empty());
  }
}

TEST(PointingRecogniser, DropsPositionsThatAreNotFinite) {
  PointingRecogniser recogniser({}, TestModels());
  scene::Hands hands = HandAt(0.0, {100.0, 100.0});
  hands.hands[0].centre_px.x() = std::nan("");
  EXPECT_TRUE(recogniser.ObserveHands(hands).state.hypotheses.empty());
}

/// Places, sizes and covariances anywhere within what messages may say, now tiny and now huge.
class AnyScene {
 public:
  double Pixels() { return (random_() % 2 == 0 ? 1.0 : -1.0) * Size(1e-3); }
  double Size(double least) {
    return std::min(1e6, std::max(least, std::pow(10.0, exponent_(random_))));
  }
  scene::Objects Objects(double time_s) {
    scene::Objects objects;
    objects.time = At(time_s);
    objects.objects = {ObjectAt(3, {0.0, 0.0}), FaceAt({0.0, 0.0})};
    objects.objects[0].box = scene::Box{Pixels(), Pixels(), Size(0.0), Size(0.0)};
    objects.objects[1].box = scene::Box{Pixels(), Pixels(), Size(1.0), Size(1.0)};
    return objects;
  }
  scene::Hands Hands(double time_s) {
    if (random_() % 8 == 0) place_px_ = {Pixels(), Pixels()};
    scene::Hands hands = HandAt(time_s, place_px_);
    hands.hands[0].covariance.setConstant(Pixels() * 1e6);
    return hands;
  }

 private:
  std::mt19937 random_{1};
  std::uniform_real_distribution<double> exponent_{-3.0, 6.5};
  Eigen::Vector2d place_px_ = Eigen::Vector2d::Zero();
};

TEST(PointingRecogniser, StaysFiniteWithinTheBoundsOfWhatMessagesMaySay) {
  for (const Method method : {Method::kSegmental, Method::kAsPrinted}) {
    PointingRecogniserConfig config;
    config.method = method;
    PointingRecogniser recogniser(config, TestModels());
    AnyScene scene;
    for (int i = 0; i < 1500; ++i) {
      recogniser.ObserveObjects(scene.Objects(i / 15.0));
      for (const auto& it : recogniser.ObserveHands(scene.Hands(i / 15.0)).state.hypotheses) {
        ASSERT_TRUE(std::isfinite(it.phase)) << i;
        ASSERT_TRUE(std::isfinite(it.end_probability)) << i;
        ASSERT_TRUE(std::isfinite(it.none_probability)) << i;
      }
    }
  }
}

TEST(PointingRecogniser, AsPrintedNamesTheObjectToo) {
  PointingRecogniserConfig config;
  config.method = Method::kAsPrinted;
  const auto begun = Begun(Recognise({}, config));
  ASSERT_FALSE(begun.empty());
  EXPECT_EQ(begun[0].object_id, 3);
}

TEST(PointingRecogniser, AsPrintedRepeatsItselfExactly) {
  PointingRecogniserConfig config;
  config.method = Method::kAsPrinted;
  const auto once = Recognise({}, config);
  const auto again = Recognise({}, config);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    ASSERT_EQ(once[i].candidates.size(), again[i].candidates.size());
    for (std::size_t k = 0; k < once[i].candidates.size(); ++k) {
      EXPECT_EQ(once[i].candidates[k].probability, again[i].candidates[k].probability);
    }
  }
}

TEST(PointingRecogniser, JudgesTheActingHandAloneWhenAsked) {
  PointingRecogniserConfig config;
  config.hands = HandChoice::kActing;
  PointingRecogniser recogniser(config, TestModels());
  scene::Hands hands = HandAt(0.0, {100.0, 100.0});
  hands.hands[0].is_acting = false;
  EXPECT_TRUE(recogniser.ObserveHands(hands).state.hypotheses.empty());
}

}  // namespace
}  // namespace deixis::gesture_recogniser
