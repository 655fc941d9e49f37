#include "services/gesture_recogniser/core/training.h"

#include <gmock/gmock.h>

#include "services/gesture_recogniser/evaluation/examples.h"
#include "services/gesture_recogniser/evaluation/recording.h"
#include "services/gesture_recogniser/evaluation/tracked_hands.h"
#include "test/services/gesture_recogniser/gesture_scene.h"
#include "test/support/temporary_folder.h"

namespace deixis::gesture_recogniser {
namespace {

using testing::HasSubstr;

/// The pointing scene as a recording.
Recording SceneRecording(const std::string& person) {
  const PointingScene scene;
  Recording recording;
  recording.name = "scene";
  recording.person = person;
  recording.objects = {scene.objects[0], scene.objects[1]};
  recording.gestures = {{1.5, 2.1, 3.1, 3.7, scene::Side::kLeft, 3}};
  for (int i = 0; i < 90; ++i) {
    RecordedFrame frame;
    frame.time_s = i / 15.0;
    frame.face = scene.objects[2].box;
    frame.hands = {{0, scene::Side::kLeft, scene.Hand(frame.time_s), 0.0, true, true}};
    recording.frames.push_back(frame);
  }
  return recording;
}

TEST(TrainModels, LearnsDurationAndGapOfItsExamples) {
  TrackNoise noise;
  noise.sigma_px = 0.0;
  const auto models = TrainModels({SceneRecording("a"), SceneRecording("b")}, "", noise, {}, {});
  ASSERT_EQ(models.size(), 2U);
  EXPECT_EQ(models[0].examples, 2);
  EXPECT_NEAR(models[0].duration_s, 0.6, 1e-6);
  EXPECT_NEAR(models[0].target.gap_m, std::hypot(31.0, 25.0) / kTestPxPerM, 0.01);
  EXPECT_EQ(models[1].name, "rest");
}

TEST(TrainModels, ContextAreaShrinksAsTheHandApproaches) {
  const auto models = TrainModels({SceneRecording("a")}, "", {}, {}, {});
  double last = 1e9;
  for (const ModelPoint& point : models[0].points) {
    if (point.context_radius_m <= 0.0) continue;
    EXPECT_LE(point.context_radius_m, last);
    last = point.context_radius_m;
  }
  EXPECT_LT(last, 1e9);
}

TEST(TrainModels, LeavesAPersonOut) {
  const std::vector<Recording> both{SceneRecording("a"), SceneRecording("b")};
  EXPECT_EQ(TrainModels(both, "b", {}, {}, {})[0].examples, 1);
  EXPECT_THROW(TrainModels({SceneRecording("a")}, "a", {}, {}, {}), std::invalid_argument);
}

TEST(Recording, ReadsWhatIsWrittenInIt) {
  const test::TemporaryFolder folder;
  const Recording recording = ReadRecording(folder.Write("a.recording",
                                                         "recording one anna\n"
                                                         "object 4 cup 10 20 30 40\n"
                                                         "gesture 1 1.5 2 2.5 left 4\n"
                                                         "frame 0.5\n"
                                                         "face 1 2 3 4\n"
                                                         "hand 7 right 100 200 2.5 1 0\n"));
  EXPECT_EQ(recording.person, "anna");
  EXPECT_EQ(recording.objects[0].label, "cup");
  EXPECT_EQ(recording.gestures[0].side, scene::Side::kLeft);
  EXPECT_EQ(recording.frames[0].hands[0].id, 7);
  EXPECT_DOUBLE_EQ(recording.frames[0].hands[0].sigma_px, 2.5);
}

TEST(Recording, NamesTheLineThatMakesNoSense) {
  const test::TemporaryFolder folder;
  try {
    ReadRecording(folder.Write("a.recording", "recording one anna\nhand 1 left 1 2 3 1 0\n"));
    FAIL() << "accepted";
  } catch (const config::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.recording:2"));
  }
}

TEST(Recording, RefusesALineWithMoreWordsThanItHas) {
  const test::TemporaryFolder folder;
  try {
    ReadRecording(folder.Write("a.recording", "recording my walk anna\n"));
    FAIL() << "accepted";
  } catch (const config::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.recording:1: 'recording my walk anna'"));
  }
}

TEST(TrackedHands, NoiseDependsOnTheSeedAlone) {
  TrackNoise noise;
  const auto once = TrackedHands(SceneRecording("a"), noise);
  const auto again = TrackedHands(SceneRecording("a"), noise);
  noise.seed = 2;
  const auto other = TrackedHands(SceneRecording("a"), noise);
  EXPECT_EQ(once[30].hands[0].centre_px, again[30].hands[0].centre_px);
  EXPECT_NE(once[30].hands[0].centre_px, other[30].hands[0].centre_px);
}

}  // namespace
}  // namespace deixis::gesture_recogniser
