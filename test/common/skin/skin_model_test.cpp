#include "common/skin/skin_model.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace deixis::skin {
namespace {

const cv::Scalar kLightSkin(140, 165, 215);
const cv::Scalar kDarkSkin(60, 80, 125);
const cv::Scalar kWood(95, 140, 190);
const cv::Scalar kJeans(110, 85, 65);
const scene::Box kFace{40, 30, 60, 60};

double ProbabilityOf(const SkinModel& model, const cv::Scalar& colour) {
  return model.Probability(colour[0], colour[1], colour[2]);
}

cv::Mat PictureOfFace(const cv::Scalar& skin, const cv::Scalar& room) {
  cv::Mat picture(120, 160, CV_8UC3, room);
  cv::ellipse(picture, {70, 60}, {26, 34}, 0, 0, 360, skin, cv::FILLED);
  return picture;
}

TEST(SkinModel, KnowsSkinOfAllShadesBeforeItSawAFace) {
  const SkinModel model;
  EXPECT_GT(ProbabilityOf(model, kLightSkin), 0.5);
  EXPECT_GT(ProbabilityOf(model, kDarkSkin), 0.5);
  EXPECT_LT(ProbabilityOf(model, kJeans), 0.1);
  EXPECT_LT(ProbabilityOf(model, {80, 160, 80}), 0.1);
}

TEST(SkinModel, PrefersThePersonsOwnColourOnceItSawTheFace) {
  SkinModel model;
  const double wood_before = ProbabilityOf(model, kWood);
  ASSERT_TRUE(model.LearnFromFace(PictureOfFace(kLightSkin, kJeans), kFace, 0.0));
  EXPECT_TRUE(model.knows_face());
  EXPECT_GT(ProbabilityOf(model, kLightSkin), 0.8);
  EXPECT_LT(ProbabilityOf(model, kWood), wood_before);
}

TEST(SkinModel, RefusesAFaceThatShowsNoSkin) {
  SkinModel model;
  EXPECT_FALSE(model.LearnFromFace(PictureOfFace(kJeans, kWood), kFace, 0.0));
  EXPECT_FALSE(model.knows_face());
}

TEST(SkinModel, FollowsTheLight) {
  SkinModel model;
  const cv::Scalar dim = 0.5 * kLightSkin;
  model.LearnFromFace(PictureOfFace(kLightSkin, kJeans), kFace, 0.0);
  const double before = ProbabilityOf(model, dim);
  for (int i = 0; i < 20; ++i) model.LearnFromFace(PictureOfFace(dim, kJeans), kFace, 0.5);
  EXPECT_GT(ProbabilityOf(model, dim), before);
  EXPECT_GT(ProbabilityOf(model, dim), 0.8);
}

TEST(SkinModel, TrustsAColourLessWhenTheSceneIsFullOfIt) {
  SkinModel model;
  const cv::Mat room(120, 160, CV_8UC3, kWood);
  model.LearnFromFace(PictureOfFace(kLightSkin, kWood), kFace, 0.0);
  const double before = ProbabilityOf(model, kWood);
  model.LearnFromScene(room, cv::Mat(room.size(), CV_8UC1, cv::Scalar(255)), 10.0);
  EXPECT_LT(ProbabilityOf(model, kWood), before);
}

TEST(SkinModel, AcceptsAFaceThatReachesOverTheEdge) {
  SkinModel model;
  const cv::Mat picture = PictureOfFace(kLightSkin, kJeans);
  EXPECT_NO_THROW(model.LearnFromFace(picture, {-500, -500, 60, 60}, 0.0));
  EXPECT_NO_THROW(model.LearnFromFace(picture, {120, 80, 90, 90}, 0.0));
}

TEST(SkinModel, TableAgreesWithTheProbability) {
  const SkinModel model;
  const cv::Mat pixel(1, 1, CV_8UC3, cv::Scalar(140, 164, 212));  // The middle of its cell.
  const cv::Mat looked_up = Classify(pixel, model.table());
  EXPECT_NEAR(looked_up.at<std::uint8_t>(0, 0) / 255.0, model.Probability(140, 164, 212), 0.01);
}

}  // namespace
}  // namespace deixis::skin
