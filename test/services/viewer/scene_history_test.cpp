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

TEST_F(SceneHistoryTest, KeepsNoMorePicturesThanItMay) {
  for (int i = 1; i <= 100; ++i) AddImage(i);
  EXPECT_FALSE(history_.From(Time(70)));
  EXPECT_TRUE(history_.From(Time(90)));
}

}  // namespace
}  // namespace deixis::viewer
