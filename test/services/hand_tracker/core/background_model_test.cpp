#include "services/hand_tracker/core/background_model.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace deixis::hand_tracker {
namespace {

constexpr double kPeriod_s = 0.05;
constexpr int kReach_px = 5;
const cv::Rect kThing(70, 50, 12, 12);

cv::Mat Room() {
  cv::Mat room(120, 160, CV_8UC3, cv::Scalar(90, 110, 130));
  room(cv::Rect(0, 0, 80, 60)).setTo(cv::Scalar(150, 140, 120));
  return room;
}

cv::Mat RoomWithThing(const cv::Point& shift = {}) {
  cv::Mat room = Room();
  room(kThing + shift).setTo(cv::Scalar(60, 80, 200));
  return room;
}

cv::Mat NothingHeld() { return cv::Mat::zeros(120, 160, CV_8UC1); }

BackgroundModel LearnedRoom() {
  BackgroundModel model;
  for (int i = 0; i < 60; ++i) model.Update(Room(), NothingHeld(), kPeriod_s, kReach_px);
  return model;
}

int KnowledgeAt(const BackgroundModel& model, int x, int y) {
  return model.knowledge().at<std::uint8_t>(y, x);
}

TEST(BackgroundModel, KnowsNothingAtFirstAndTheRoomAfterAWhile) {
  BackgroundModel model;
  model.Update(Room(), NothingHeld(), 0.0, kReach_px);
  EXPECT_EQ(KnowledgeAt(model, 20, 20), BackgroundModel::kUnknown);
  EXPECT_EQ(KnowledgeAt(LearnedRoom(), 20, 20), BackgroundModel::kBackground);
}

TEST(BackgroundModel, ShowsWhatIsNewAsForeground) {
  BackgroundModel model = LearnedRoom();
  model.Update(RoomWithThing(), NothingHeld(), kPeriod_s, kReach_px);
  EXPECT_EQ(KnowledgeAt(model, 75, 55), BackgroundModel::kForeground);
  EXPECT_EQ(KnowledgeAt(model, 20, 20), BackgroundModel::kBackground);
  EXPECT_NE(model.changed().at<std::uint8_t>(55, 75), 0);
}

TEST(BackgroundModel, WhatStaysBecomesBackgroundUnlessHeld) {
  cv::Mat held = NothingHeld();
  held(kThing).setTo(255);
  BackgroundModel left_alone = LearnedRoom();
  BackgroundModel holding = LearnedRoom();
  for (int i = 0; i < 200; ++i) {
    left_alone.Update(RoomWithThing(), NothingHeld(), kPeriod_s, kReach_px);
    holding.Update(RoomWithThing(), held, kPeriod_s, kReach_px);
  }
  EXPECT_EQ(KnowledgeAt(left_alone, 75, 55), BackgroundModel::kBackground);
  EXPECT_EQ(KnowledgeAt(holding, 75, 55), BackgroundModel::kForeground);
}

TEST(BackgroundModel, WhatKeepsMovingStaysForeground) {
  BackgroundModel model = LearnedRoom();
  for (int i = 0; i < 200; ++i) {
    model.Update(RoomWithThing({(i / 4) % 2 * 4, 0}), NothingHeld(), kPeriod_s, kReach_px);
  }
  EXPECT_EQ(KnowledgeAt(model, 76, 55), BackgroundModel::kForeground);
}

TEST(BackgroundModel, EvensOutTheLight) {
  BackgroundModel model = LearnedRoom();
  cv::Mat dim;
  for (int i = 0; i < 10; ++i) {
    RoomWithThing().convertTo(dim, CV_8U, 1.0 - 0.05 * i);
    model.Update(dim, NothingHeld(), kPeriod_s, kReach_px);
  }
  EXPECT_EQ(KnowledgeAt(model, 20, 20), BackgroundModel::kBackground);
  EXPECT_EQ(KnowledgeAt(model, 75, 55), BackgroundModel::kForeground);
}

TEST(BackgroundModel, AShadowIsNoForeground) {
  BackgroundModel model = LearnedRoom();
  cv::Mat shaded = Room();
  cv::Mat part = shaded(kThing);
  part.convertTo(part, CV_8U, 0.75);
  model.Update(shaded, NothingHeld(), kPeriod_s, kReach_px);
  EXPECT_EQ(KnowledgeAt(model, 75, 55), BackgroundModel::kBackground);
}

TEST(BackgroundModel, NoticesThatTheCameraMoves) {
  BackgroundModel model = LearnedRoom();
  cv::Mat noise(120, 160, CV_8UC3);
  cv::RNG random(1);
  random.fill(noise, cv::RNG::UNIFORM, 0, 255);
  cv::blur(noise, noise, {9, 9});
  model.Update(0.5 * noise, NothingHeld(), kPeriod_s, kReach_px);
  EXPECT_TRUE(model.camera_moves());
  EXPECT_EQ(KnowledgeAt(model, 20, 20), BackgroundModel::kUnknown);
}

TEST(BackgroundModel, StartsAnewAtAnotherSize) {
  BackgroundModel model = LearnedRoom();
  const cv::Mat small(60, 80, CV_8UC3, cv::Scalar(10, 20, 30));
  model.Update(small, cv::Mat::zeros(60, 80, CV_8UC1), kPeriod_s, kReach_px);
  EXPECT_EQ(model.knowledge().size(), small.size());
  EXPECT_EQ(KnowledgeAt(model, 5, 5), BackgroundModel::kUnknown);
}

}  // namespace
}  // namespace deixis::hand_tracker
