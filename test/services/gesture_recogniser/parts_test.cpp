#include <gmock/gmock.h>

#include <filesystem>

#include "common/filtering/log_probability.h"
#include "services/gesture_recogniser/core/condensation.h"
#include "services/gesture_recogniser/core/context.h"
#include "services/gesture_recogniser/core/destination.h"
#include "services/gesture_recogniser/core/hold.h"
#include "services/gesture_recogniser/core/image_scale.h"
#include "services/gesture_recogniser/core/rest_place.h"
#include "services/gesture_recogniser/core/stroke.h"
#include "test/services/gesture_recogniser/gesture_scene.h"
#include "test/support/temporary_folder.h"

namespace deixis::gesture_recogniser {

using filtering::kImpossible;
using filtering::kTwoPi;

namespace {

using testing::HasSubstr;

/// Motion of a hand whose place at `t` seconds is `place(t)` metres, from 0 to `end_s`.
template <typename Place>
Motion MotionOf(Place place, double end_s, double rate_hz = 15.0, double sigma_m = 0.004) {
  MotionHistory history{MotionConfig{}};
  for (double time_s = 0.0; time_s <= end_s + 1e-6; time_s += 1.0 / rate_hz) {
    history.Add({At(time_s), place(time_s), sigma_m, true});
  }
  return history.Sample(1.0);
}

Eigen::Vector2d Along(double metres) { return {metres, 0.0}; }

TEST(MotionHistory, GivesTheSameSpeedsForAnyFrameRate) {
  for (const double rate_hz : {10.0, 15.0, 30.0, 100.0}) {
    const Motion motion = MotionOf([](double t) { return Along(0.5 * t); }, 2.0, rate_hz);
    ASSERT_GT(motion.size(), 20U);
    EXPECT_NEAR(motion.speed_m_per_s[3], 0.5, 1e-3) << rate_hz;
    EXPECT_NEAR(motion.turn_rad[3], 0.0, 1e-3) << rate_hz;
  }
}

TEST(MotionHistory, MeasuresTheChangeOfDirection) {
  const Motion motion = MotionOf(
      [](double t) {
        const double angle = 1.5 * t;
        return Eigen::Vector2d(std::cos(angle), std::sin(angle));
      },
      2.0);
  EXPECT_NEAR(motion.turn_rad[2], 1.5 / 15.0, 1e-3);
}

TEST(MotionHistory, BeginsAnewAfterAGapAndWhenTimeGoesBack) {
  MotionHistory history{MotionConfig{}};
  EXPECT_FALSE(history.Add({At(1.0), {0.0, 0.0}, 1.0, true}));
  EXPECT_TRUE(history.Add({At(1.1), {0.0, 0.0}, 1.0, true}));
  EXPECT_FALSE(history.Add({At(1.8), {0.0, 0.0}, 1.0, true}));
  EXPECT_EQ(history.Sample(1.0).size(), 1U);
  EXPECT_FALSE(history.Add({At(1.6), {0.0, 0.0}, 1.0, true}));
  EXPECT_EQ(history.Sample(1.0).size(), 1U);
}

TEST(MotionHistory, ForgetsPredictionsWhenTheHandIsSeenAgain) {
  MotionHistory history{MotionConfig{}};
  const auto add = [&history](int step, double metres, bool is_measured) {
    history.Add({At(step / 15.0), {metres, 0.0}, 0.001, is_measured});
  };
  for (int i = 0; i < 4; ++i) add(i, 0.0, true);
  add(4, 0.7, false);
  add(5, 0.9, false);
  add(6, 0.3, true);
  const Motion& motion = history.Sample(1.0);
  EXPECT_NEAR(motion.position_m[1].x(), 0.2, 1e-4);
  EXPECT_NEAR(motion.position_m[2].x(), 0.1, 1e-4);
}

TEST(WrapAngle, StaysWithinHalfATurn) {
  EXPECT_NEAR(WrapAngle(3.5), 3.5 - kTwoPi, 1e-12);
  EXPECT_NEAR(WrapAngle(-7.0), -7.0 + kTwoPi, 1e-12);
}

TEST(Stroke, PrefersAStrokeToFreeMotionAndToRest) {
  Stroke stroke({}, TestModels()[0], 1.0 / 15.0);
  stroke.Observe(MotionOf([](double t) { return OnWay({0, 0}, {0.35, 0}, t, 1.0); }, 1.8), 6);
  EXPECT_GT(stroke.At(3).log_odds, 3.0);
  EXPECT_NEAR(stroke.At(3).duration_s, 0.6, 0.2);
  stroke.Observe(MotionOf([](double) { return Along(0.0); }, 1.8), 6);
  EXPECT_LT(stroke.At(3).log_odds, 0.0);
  stroke.Observe(MotionOf([](double t) { return Along(0.6 * t); }, 1.8), 6);
  EXPECT_LT(stroke.At(3).log_odds, 0.0);
}

TEST(Stroke, IsImpossibleWhereTheMotionIsTooShort) {
  Stroke stroke({}, TestModels()[0], 1.0 / 15.0);
  stroke.Observe(MotionOf([](double) { return Along(0.0); }, 0.2), 3);
  EXPECT_EQ(stroke.At(3).log_odds, kImpossible);
}

TEST(JudgeHold, TellsAHeldHandFromOneThatMovesOn) {
  EXPECT_GT(JudgeHold({}, MotionOf([](double) { return Along(0.3); }, 1.0), 6).log_odds, 1.0);
  EXPECT_LT(JudgeHold({}, MotionOf([](double t) { return Along(0.4 * t); }, 1.0), 6).log_odds,
            -2.0);
}

TEST(JudgeHold, TellsAHeldHandFromOneThatTurnsBack) {
  const Motion there_and_back =
      MotionOf([](double t) { return Along(0.6 * std::abs(t - 0.83)); }, 1.0);
  EXPECT_LT(JudgeHold({}, there_and_back, 6).log_odds, -2.0);
}

TEST(RestPlace, IsWhereTheHandStaysBelowTheFace) {
  RestPlace rest({});
  const scene::Box face{0.0, 0.0, 0.19, 0.19};
  rest.Observe(MotionOf([](double) { return Eigen::Vector2d(0.2, 0.9); }, 1.5), face);
  ASSERT_TRUE(rest.position_m());
  EXPECT_NEAR(rest.position_m()->y(), 0.9, 1e-6);
  rest.Observe(MotionOf([](double) { return Eigen::Vector2d(0.2, 0.2); }, 1.5), face);
  EXPECT_NEAR(rest.position_m()->y(), 0.9, 1e-6);
}

TEST(RestPlace, IsNotTheHoldOfAGesture) {
  RestPlace rest({});
  rest.NoteGesture({0.2, 0.9});
  rest.Observe(MotionOf([](double) { return Eigen::Vector2d(0.21, 0.9); }, 1.5), std::nullopt);
  EXPECT_FALSE(rest.position_m());
}

Target TargetAt(const Eigen::Vector2d& centre_m) {
  return {1, "thing", {centre_m.x() - 0.05, centre_m.y() - 0.05, 0.1, 0.1}};
}

DestinationDensities Densities(const Arrival& arrival, const Surroundings& surroundings,
                               const std::optional<Eigen::Vector2d>& rest_m) {
  return Destinations({}, TestModels()[0].target)
      .Judge(arrival, surroundings, rest_m, scene::Side::kRight);
}

TEST(Destinations, FavourTheObjectInTheDirectionOfArrival) {
  Arrival arrival;
  arrival.position_m = {1.0, 1.0};
  arrival.way_m = {0.15, 0.0};
  arrival.sigma_m = arrival.way_sigma_m = 0.01;
  Surroundings surroundings;
  surroundings.targets = {TargetAt({1.25, 1.0}), TargetAt({1.0, 1.25}), TargetAt({2.5, 1.0})};
  const auto densities = Densities(arrival, surroundings, std::nullopt);
  EXPECT_GT(densities.target[0], densities.target[1] + 1.0);
  EXPECT_GT(densities.target[0], densities.elsewhere);
  EXPECT_LT(densities.target[2], densities.elsewhere);
}

TEST(Destinations, RestTakesReturningStrokesOnly) {
  Arrival arrival;
  arrival.position_m = {1.0, 1.0};
  arrival.nearest_rest_m = 0.4;
  const double returning = Densities(arrival, {}, Eigen::Vector2d(1.02, 1.0)).rest;
  arrival.nearest_rest_m = 0.0;
  const double leaving = Densities(arrival, {}, Eigen::Vector2d(1.02, 1.0)).rest;
  EXPECT_GT(returning, leaving + 5.0);
}

TEST(ForearmDirection, PointsAboveTheLineFromShoulderToHandWhenTheArmIsBent) {
  const Eigen::Vector2d bent = ForearmDirection({0.0, 0.0}, {0.4, 0.0}, 0.6);
  EXPECT_LT(bent.y(), -0.05);
  const Eigen::Vector2d stretched = ForearmDirection({0.0, 0.0}, {0.59, 0.0}, 0.6);
  EXPECT_NEAR(stretched.y(), 0.0, 1e-6);
  const Eigen::Vector2d hanging = ForearmDirection({0.0, 0.0}, {0.0, 0.4}, 0.6);
  EXPECT_NEAR(hanging.x(), 0.0, 1e-9);
}

TEST(ContextAreas, HoldWhatIsNearAndInDirection) {
  ContextAreas areas;
  const GestureModel model = TestModels()[0];
  const std::vector<Target> targets{TargetAt({0.3, 0.0}), TargetAt({0.0, 0.3}),
                                    TargetAt({3.0, 0.0})};
  areas.Update(model, ContextUse::kDirected, {0.0, 0.0}, {1.0, 0.0}, targets);
  EXPECT_FALSE(areas.HasArea(0));
  EXPECT_EQ(areas.Inside(20), TargetSet{1});
  areas.Update(model, ContextUse::kDistance, {0.0, 0.0}, {1.0, 0.0}, targets);
  EXPECT_EQ(areas.Inside(20), TargetSet{3});
  areas.Update(model, ContextUse::kNone, {0.0, 0.0}, {1.0, 0.0}, targets);
  EXPECT_FALSE(areas.HasArea(20));
}

TEST(TargetSet, PicksByRank) {
  EXPECT_EQ(Count(0b10110), 3);
  EXPECT_EQ(Pick(0b10110, 0), 1);
  EXPECT_EQ(Pick(0b10110, 2), 4);
}

TEST(ImageScale, ComesFromTheFaceThenTheCameraThenTheConfiguration) {
  ImageScale scale({});
  const scene::Hands hands = HandAt(0.0, {0.0, 0.0});
  EXPECT_DOUBLE_EQ(scale.PixelsPerMetre(scale.FaceOf(hands.hands[0], At(0.0))), 277.0);
  scale.SetFocalLength(600.0);
  EXPECT_DOUBLE_EQ(scale.PixelsPerMetre(scale.FaceOf(hands.hands[0], At(0.0))), 300.0);
  scene::Objects objects;
  objects.time = At(0.0);
  objects.objects = {FaceAt({300.0, 90.0})};
  scale.Observe(objects);
  EXPECT_NEAR(scale.PixelsPerMetre(scale.FaceOf(hands.hands[0], At(0.1))), kTestPxPerM, 1e-9);
  EXPECT_FALSE(scale.FaceOf(hands.hands[0], At(60.0)));
}

TEST(ImageScale, ForgetsFacesThatAreOutOfSight) {
  ImageScale scale({});
  for (int i = 0; i < 100; ++i) {
    scene::Objects objects;
    objects.time = At(i);
    objects.objects = {FaceAt({300.0, 90.0})};
    objects.objects[0].id = i;
    scale.Observe(objects);
  }
  EXPECT_EQ(scale.known_faces(), 6U);  // Of the last 5 s.
}

TEST(GestureModel, RefusesAFileOfAnotherName) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "gestures");
  folder.Write("gestures/wave.yaml", ToYaml(TestModels()[0]));
  setenv("DEIXIS_CONFIG_DIR", folder.path().c_str(), 1);
  EXPECT_THAT([] { LoadModels({"wave"}); },
              testing::ThrowsMessage<config::ConfigError>(HasSubstr("'name' is 'approach'")));
}

TEST(GestureModel, SurvivesBeingWrittenAndRead) {
  const GestureModel model = TestModels()[0];
  const test::TemporaryFolder folder;
  const auto read = config::Load<GestureModel>(folder.Write("m.yaml", ToYaml(model)), {},
                                               config::Completeness::kEveryKey);
  EXPECT_EQ(read.name, model.name);
  EXPECT_EQ(read.context, model.context);
  ASSERT_EQ(read.points.size(), model.points.size());
  EXPECT_NEAR(read.points[12].context_radius_m, model.points[12].context_radius_m, 1e-4);
}

TEST(GestureModel, RefusesSpreadsThatAreNotPositive) {
  GestureModel model = TestModels()[0];
  model.points[4].turn_spread_rad = 0.0;
  try {
    model.Validate();
    FAIL() << "accepted";
  } catch (const config::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("points[4].turn_spread_rad"));
  }
}

TEST(GestureModel, RefusesAFileThatWasCutOff) {
  GestureModel model = TestModels()[0];
  model.points.resize(3);
  EXPECT_THAT([&model] { model.Validate(); },
              testing::ThrowsMessage<config::ConfigError>(HasSubstr("'points' must be 8 to 1000")));
}

TEST(GestureModel, RefusesAFolderInItsPlace) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "gestures" / "approach.yaml");
  setenv("DEIXIS_CONFIG_DIR", folder.path().c_str(), 1);
  EXPECT_THAT([] { LoadModels({"approach"}); },
              testing::ThrowsMessage<config::ConfigError>(HasSubstr("is not a file")));
}

TEST(RecogniserConfig, RefusesWhatWouldTakeForever) {
  MotionConfig motion;
  for (const double step_s : {1e-9, 1e-4, 0.0}) {
    motion.step_s = step_s;
    EXPECT_THROW(motion.Validate(), config::ConfigError) << step_s;
  }
  CondensationConfig as_printed;
  EXPECT_NO_THROW(as_printed.Validate());
  as_printed.samples = 10'000'000;
  EXPECT_THROW(as_printed.Validate(), config::ConfigError);
  GestureModel model = TestModels()[0];
  model.duration_s = 1e9;
  EXPECT_THROW(model.Validate(), config::ConfigError);
}

TEST(RecogniserConfig, RefusesAScaleThatMakesEverythingVanish) {
  ImageScaleConfig scale;
  EXPECT_NO_THROW(scale.Validate());
  scale.face_height_m = 1e300;
  EXPECT_THROW(scale.Validate(), config::ConfigError);
}

TEST(GestureModel, ShippedModelsLoad) {
  setenv("DEIXIS_CONFIG_DIR", (std::string(DEIXIS_SOURCE_DIR) + "/config").c_str(), 1);
  const auto models = LoadModels({"approach", "rest"});
  EXPECT_EQ(models[0].context, ContextNeed::kRequired);
  EXPECT_EQ(models[1].context, ContextNeed::kNone);
}

}  // namespace
}  // namespace deixis::gesture_recogniser
