#include "services/viewer/core/scene_history.h"

#include <gtest/gtest.h>

namespace deixis::viewer {
namespace {

constexpr std::int64_t kPeriod_us = 33'333;

class SceneHistoryTest : public testing::Test {
 protected:
  void AddImage(int number) {
    history_.Add(images::Image{Time(number), "CAMERA", cv::Mat(2, 2, CV_8UC3)});
  }
  void AddHands(int number) { history_.Add(scene::Hands{Time(number), "CAMERA", "", {}}); }
  void AddObjects(int number) { history_.Add(scene::Objects{Time(number), "CAMERA", "", "", {}}); }
  void Decide(int number) {
    scene::Gesture gesture;
    gesture.time = Time(number);
    history_.Add(gesture);
  }
  static Timestamp Time(int number) { return {number * kPeriod_us}; }
  /// Number of the picture that is ready; -1 = none.
  int Taken() {
    const auto scene = history_.Take();
    return scene ? static_cast<int>(scene->image.time.microseconds / kPeriod_us) : -1;
  }
  SceneHistory history_{SceneHistoryConfig{}};
};

TEST_F(SceneHistoryTest, GivesAPictureAtOnceWhereNobodyAnswers) {
  AddImage(1);
  EXPECT_EQ(Taken(), 1);
  EXPECT_EQ(Taken(), -1);
}

TEST_F(SceneHistoryTest, WaitsForTheResultsOfThePicture) {
  AddHands(0);
  AddImage(1);
  EXPECT_EQ(Taken(), -1);
  AddHands(1);
  const auto scene = history_.Take();
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->hands->time, Time(1));
}

TEST_F(SceneHistoryTest, WaitsForAllThatAnswer) {
  AddHands(0);
  AddObjects(0);
  AddImage(1);
  AddHands(1);
  EXPECT_EQ(Taken(), -1);
  AddObjects(1);
  EXPECT_EQ(Taken(), 1);
}

TEST_F(SceneHistoryTest, DoesNotWaitForResultsLongerThanItMay) {
  AddHands(0);
  for (int i = 1; i <= 10; ++i) AddImage(i);
  EXPECT_EQ(Taken(), -1);
  AddImage(11);  // More than 0.3 s after the first.
  EXPECT_EQ(Taken(), 1);
}

TEST_F(SceneHistoryTest, TakesTheNewestPictureThatIsReady) {
  AddHands(0);
  for (int i = 1; i <= 4; ++i) AddImage(i);
  AddHands(3);
  EXPECT_EQ(Taken(), 3);
  AddHands(2);  // Too late.
  EXPECT_EQ(Taken(), -1);
}

TEST_F(SceneHistoryTest, TakesTheResultBeforeForAPictureThatWasPassedOver) {
  AddImage(1);
  AddHands(1);
  AddImage(2);
  AddHands(3);
  AddImage(3);
  EXPECT_EQ(Taken(), 3);
  EXPECT_EQ(history_.From(Time(2))->hands->time, Time(1));
}

TEST_F(SceneHistoryTest, DoesNotDrawResultsThatAreTooOld) {
  AddHands(0);
  AddImage(100);
  const auto scene = history_.Take();
  ASSERT_TRUE(scene);
  EXPECT_FALSE(scene->hands);
}

TEST_F(SceneHistoryTest, KeepsADecisionForAWhile) {
  Decide(1);
  AddImage(1);
  EXPECT_TRUE(history_.Take()->decision);
  AddImage(70);
  EXPECT_TRUE(history_.Take()->decision);
  AddImage(80);
  EXPECT_FALSE(history_.Take()->decision);
}

TEST_F(SceneHistoryTest, FindsThePictureOfAnEvent) {
  for (int i = 1; i <= 5; ++i) AddImage(i);
  EXPECT_EQ(history_.From(Time(3))->image.time, Time(3));
  EXPECT_EQ(history_.From({Time(3).microseconds - 5})->image.time, Time(3));
  EXPECT_FALSE(history_.From(Time(6)));
}

TEST_F(SceneHistoryTest, BeginsAnewWhenTimeGoesBack) {
  AddImage(1000);
  AddHands(1000);
  Decide(1000);
  Taken();
  AddImage(1);
  const auto scene = history_.Take();
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->image.time, Time(1));
  EXPECT_FALSE(scene->hands);
  EXPECT_FALSE(scene->decision);
}

/// Pictures of a stereo rig, and people in them.
class BodiesInHistoryTest : public SceneHistoryTest {
 protected:
  BodiesInHistoryTest() {
    calibration_.camera = "STEREO";
    calibration_.rectified.width_px = 4;
    calibration_.rectified.height_px = 4;
    calibration_.rectified.focal_px = {8.0, 8.0};
  }
  void AddLeft(int number) {
    history_.Add(images::Image{Time(number), "STEREO", cv::Mat(2, 2, CV_8UC3)});
  }
  void AddBodies(int number, const std::string& camera = "STEREO") {
    body_model::BodyPoses poses{Time(number), camera, camera, "", {}, {}};
    poses.bodies.emplace_back().model_id = model_.body.id();
    history_.Add(poses);
  }
  static body_model::PersonModel ModelOfLength(double length_m) {
    body_model::Limb limb;
    limb.name = "torso";
    limb.shape = {0.1, 0.1, 0.1, 0.1, length_m};
    return {{}, body_model::BodyModel("torso", {limb})};
  }
  geometry::StereoCalibration calibration_;
  body_model::PersonModel model_ = ModelOfLength(0.5);
};

TEST_F(BodiesInHistoryTest, WaitsForThePeopleInThePicture) {
  history_.Add(calibration_);
  AddBodies(0);
  AddLeft(1);
  EXPECT_EQ(Taken(), -1);
  AddBodies(1);
  const auto scene = history_.Take();
  ASSERT_TRUE(scene && scene->bodies);
  EXPECT_EQ(scene->bodies->time, Time(1));
}

TEST_F(BodiesInHistoryTest, GivesTheModelsThatAreUsedAndTheLensOfThePicture) {
  history_.Add(calibration_);
  history_.Add(model_);
  history_.Add(ModelOfLength(0.6));
  AddBodies(1);
  AddLeft(1);
  const auto scene = history_.Take();
  ASSERT_TRUE(scene && scene->camera);
  ASSERT_EQ(scene->models.size(), 1u);
  EXPECT_EQ(scene->models[0].body.id(), model_.body.id());
  EXPECT_EQ(scene->camera->focal_px, Eigen::Vector2d(4.0, 4.0)) << "the picture is half as large";
}

TEST_F(BodiesInHistoryTest, ForgetsModelsOnlyWhenThereAreMany) {
  history_.Add(calibration_);
  history_.Add(model_);
  for (int i = 0; i < 63; ++i) history_.Add(ModelOfLength(1.0 + 0.01 * i));
  AddBodies(1);
  AddLeft(1);
  EXPECT_EQ(history_.Take()->models.size(), 1u);
  history_.Add(ModelOfLength(2.0));
  AddBodies(2);
  AddLeft(2);
  EXPECT_TRUE(history_.Take()->models.empty());
}

TEST_F(BodiesInHistoryTest, LeavesPeopleOutWhomThePictureDoesNotShow) {
  AddBodies(1);
  AddLeft(1);
  EXPECT_FALSE(history_.Take()->bodies) << "no lens is known";
  history_.Add(calibration_);
  AddBodies(2, "OTHER");
  AddLeft(2);
  EXPECT_FALSE(history_.Take()->bodies) << "of another camera";
  AddBodies(3);
  AddImage(3);
  EXPECT_FALSE(history_.Take()->bodies) << "the picture is of another camera";
  calibration_.rectified.width_px = 9;
  history_.Add(calibration_);
  AddBodies(4);
  AddLeft(4);
  EXPECT_FALSE(history_.Take()->bodies) << "of another aspect";
}

TEST_F(SceneHistoryTest, KeepsNoMorePicturesThanItMay) {
  for (int i = 1; i <= 100; ++i) AddImage(i);
  EXPECT_FALSE(history_.From(Time(70)));
  EXPECT_TRUE(history_.From(Time(90)));
}

}  // namespace
}  // namespace deixis::viewer
