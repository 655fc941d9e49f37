#include "services/hand_tracker/core/hand_likelihood.h"

#include <gtest/gtest.h>

namespace deixis::hand_tracker {
namespace {

HandCandidate Hand() {
  HandCandidate candidate;
  candidate.hand_length_px = 40.0;
  candidate.area_px = 0.25 * 40.0 * 40.0;
  candidate.region_length_px = 40.0;
  candidate.moving_share = 1.0;
  return candidate;
}

HandEvidence Evidence(const HandCandidate& candidate) { return Judge({}, candidate); }

TEST(HandLikelihood, WhatSwaysIsRatherAHandThanWhatNeverMoves) {
  HandCandidate furniture = Hand();
  furniture.moving_share = 0.0;
  EXPECT_GT(Evidence(Hand()).resting, 0.0);
  EXPECT_LT(Evidence(furniture).resting, -1.0);
}

TEST(HandLikelihood, OnlyWhatChangedSinceTheLastImageMovesFast) {
  HandCandidate fast = Hand();
  fast.fresh_share = 1.0;
  EXPECT_GT(Evidence(fast).moving, 1.0);
  EXPECT_LT(Evidence(Hand()).moving, -1.0);
}

TEST(HandLikelihood, ASpeckOrAWallIsNoHand) {
  for (const double area : {0.02, 3.0}) {
    HandCandidate candidate = Hand();
    candidate.area_px = area * 40.0 * 40.0;
    EXPECT_LT(Evidence(candidate).resting, Evidence(Hand()).resting - 1.0) << area;
  }
}

TEST(HandLikelihood, APlaceBesideTheFaceOrTheShoulderSpeaksAgainstAHand) {
  HandCandidate at_face = Hand();
  at_face.is_at_face = true;
  HandCandidate at_shoulder = Hand();
  at_shoulder.is_at_shoulder = true;
  EXPECT_LT(Evidence(at_face).resting, Evidence(Hand()).resting - 1.0);
  EXPECT_LT(Evidence(at_shoulder).resting, Evidence(Hand()).resting - 1.0);
}

TEST(HandLikelihood, DoesNotDependOnTheImageSize) {
  HandCandidate large = Hand();
  large.hand_length_px *= 3.0;
  large.area_px *= 9.0;
  large.region_length_px *= 3.0;
  EXPECT_NEAR(Evidence(large).resting, Evidence(Hand()).resting, 1e-9);
}

TEST(HandLikelihood, OneImageNeverSaysEverything) {
  HandCandidate absurd = Hand();
  absurd.area_px = 1e9;
  absurd.region_length_px = 1e9;
  EXPECT_GE(Evidence(absurd).resting, HandLikelihoodConfig{}.least);
  EXPECT_GE(Evidence(absurd).moving, HandLikelihoodConfig{}.least);
}

}  // namespace
}  // namespace deixis::hand_tracker
