#include "services/hand_tracker/core/hand_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace deixis::hand_tracker {
namespace {

constexpr double kHandLength_px = 50.0;
constexpr double kImage_s = 1.0 / 15.0;

LastSight Resting() {
  LastSight last;
  last.position = {100.0, 100.0};
  last.elapsed_s = kImage_s;
  return last;
}

LastSight Moving() {
  LastSight last = Resting();
  last.velocity = {600.0, 0.0};
  last.is_moving = true;
  return last;
}

NextPlace To(const LastSight& last, double x_px, double y_px) {
  return JudgeNextPlace(HandMotionConfig{}, last, {x_px, y_px}, kImage_s, kHandLength_px);
}

TEST(HandMotion, ARestingHandRatherStaysThanGoes) {
  EXPECT_GT(To(Resting(), 101.0, 100.0).resting, To(Resting(), 115.0, 100.0).resting + 1.0);
  EXPECT_GT(To(Resting(), 101.0, 100.0).resting, To(Resting(), 101.0, 100.0).moving + 1.0);
}

TEST(HandMotion, AFarPlaceIsReachedByMoving) {
  EXPECT_GT(To(Resting(), 150.0, 100.0).moving, To(Resting(), 150.0, 100.0).resting + 3.0);
}

TEST(HandMotion, AMovingHandGoesOnAsItDid) {
  EXPECT_GT(To(Moving(), 136.0, 100.0).moving, To(Moving(), 100.0, 100.0).moving);
  EXPECT_GT(To(Moving(), 136.0, 100.0).moving, To(Moving(), 64.0, 100.0).moving + 2.0);
}

TEST(HandMotion, AnUnseenHandMayBeFartherAway) {
  LastSight unseen = Resting();
  unseen.elapsed_s = 0.3;
  EXPECT_GT(To(unseen, 200.0, 100.0).moving, To(Resting(), 200.0, 100.0).moving + 1.0);
}

// The density of all next places sums up to `area`, in hand lengths squared, times its share.
TEST(HandMotion, DensitiesAreThoseOfNextPlaces) {
  double sum = 0.0;
  for (double x = -200.0; x < 400.0; x += 2.0) {
    for (double y = -200.0; y < 400.0; y += 2.0) {
      const NextPlace place = To(Moving(), x, y);
      sum += std::exp(place.resting) + std::exp(place.moving);
    }
  }
  const double cell = 4.0 / (kHandLength_px * kHandLength_px);
  EXPECT_NEAR(sum * cell / HandMotionConfig{}.area, 1.0, 0.02);
}

TEST(HandMotion, RefusesASpreadOfNothing) {
  HandMotionConfig config;
  config.rest_spread = 0.0;
  EXPECT_THROW(config.Validate(), config::ConfigError);
}

}  // namespace
}  // namespace deixis::hand_tracker
