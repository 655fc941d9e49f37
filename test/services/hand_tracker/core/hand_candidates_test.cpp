#include "services/hand_tracker/core/hand_candidates.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace deixis::hand_tracker {
namespace {

constexpr double kHandLength = 24.0;
const std::vector<Eigen::Vector2d> kShoulders = {{80, 30}, {140, 30}};

SkinPicture Picture() {
  return {cv::Mat::zeros(240, 320, CV_8UC1), cv::Mat::zeros(240, 320, CV_8UC1),
          cv::Mat::zeros(240, 320, CV_8UC1)};
}

std::vector<HandCandidate> Candidates(const SkinPicture& picture,
                                      const std::vector<Eigen::Vector2d>& shoulders = kShoulders) {
  std::vector<HandCandidate> all;
  const auto regions = FindRegions(picture.evidence, {100, 200}, 6);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    for (HandCandidate hand : FindCandidates(regions[i], picture, kHandLength, shoulders)) {
      hand.region = static_cast<int>(i);
      all.push_back(hand);
    }
  }
  return all;
}

/// A bare forearm of 9 px width from `elbow` to `fingers`.
void DrawArm(const SkinPicture& picture, cv::Point elbow, cv::Point fingers) {
  cv::line(picture.evidence, elbow, fingers, cv::Scalar(255), 9);
}

TEST(FindCandidates, TakesThePalmOfASleevedHand) {
  const SkinPicture picture = Picture();
  cv::ellipse(picture.evidence, {60, 120}, {6, 10}, 0, 0, 360, cv::Scalar(255), cv::FILLED);
  const auto hands = Candidates(picture);
  ASSERT_EQ(hands.size(), 1U);
  EXPECT_NEAR(hands[0].centre.x(), 60.0, 0.8);
  EXPECT_NEAR(hands[0].centre.y(), 120.0 - 0.08 * kHandLength, 0.5);  // A little towards the wrist.
}

TEST(FindCandidates, TakesTheEndAwayFromTheShoulderOfABareArm) {
  const SkinPicture picture = Picture();
  DrawArm(picture, {75, 60}, {60, 130});
  const auto hands = Candidates(picture);
  ASSERT_EQ(hands.size(), 1U);
  EXPECT_NEAR(hands[0].centre.y(), 134.0 - 0.5 * kHandLength, 3.0);
  EXPECT_NEAR(hands[0].tip.y(), 134.0, 3.0);
}

TEST(FindCandidates, FollowsABentArmRoundTheElbow) {
  const SkinPicture picture = Picture();
  DrawArm(picture, {75, 60}, {50, 120});
  DrawArm(picture, {50, 120}, {110, 125});
  const auto hands = Candidates(picture);
  ASSERT_GE(hands.size(), 1U);
  EXPECT_LT((hands[0].tip - Eigen::Vector2d(110, 125)).norm(), 8.0);
}

TEST(FindCandidates, OffersBothEndsWithoutAShoulder) {
  const SkinPicture picture = Picture();
  DrawArm(picture, {75, 60}, {60, 130});
  EXPECT_EQ(Candidates(picture, {}).size(), 2U);
}

TEST(FindCandidates, OffersBothHandsOfArmsThatCross) {
  const SkinPicture picture = Picture();
  DrawArm(picture, {75, 80}, {135, 130});
  DrawArm(picture, {145, 80}, {85, 130});
  bool has_left = false;
  bool has_right = false;
  for (const HandCandidate& hand : Candidates(picture)) {
    has_left = has_left || (hand.tip - Eigen::Vector2d(85, 130)).norm() < 8.0;
    has_right = has_right || (hand.tip - Eigen::Vector2d(135, 130)).norm() < 8.0;
  }
  EXPECT_TRUE(has_left);
  EXPECT_TRUE(has_right);
}

TEST(FindCandidates, TellsWhatShareOfTheHandMoves) {
  const SkinPicture picture = Picture();
  picture.evidence(cv::Rect(50, 110, 12, 16)).setTo(255);
  picture.changed(cv::Rect(50, 110, 6, 16)).setTo(255);
  EXPECT_NEAR(Candidates(picture).at(0).moving_share, 0.5, 1e-9);
}

TEST(WithoutArmPieces, DropsThePieceAboveAWatch) {
  const SkinPicture picture = Picture();
  DrawArm(picture, {75, 60}, {66, 100});
  DrawArm(picture, {63, 116}, {60, 130});
  const auto hands = WithoutArmPieces(Candidates(picture), kHandLength, kShoulders);
  ASSERT_EQ(hands.size(), 1U);
  EXPECT_GT(hands[0].centre.y(), 110.0);
}

TEST(WithoutArmPieces, KeepsBothHandsOfAPerson) {
  const SkinPicture picture = Picture();
  DrawArm(picture, {75, 70}, {60, 130});
  DrawArm(picture, {145, 70}, {160, 130});
  EXPECT_EQ(WithoutArmPieces(Candidates(picture), kHandLength, kShoulders).size(), 2U);
}

TEST(GuessHandLength, GrowsWithThePalm) {
  SkinPicture picture = Picture();
  cv::circle(picture.evidence, {60, 60}, 10, cv::Scalar(255), cv::FILLED);
  cv::circle(picture.evidence, {160, 120}, 20, cv::Scalar(255), cv::FILLED);
  const auto regions = FindRegions(picture.evidence, {100, 200}, 6);
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_NEAR(GuessHandLength(regions[1]) / GuessHandLength(regions[0]), 2.0, 0.2);
}

}  // namespace
}  // namespace deixis::hand_tracker
