#include "common/scene/box.h"

#include <gtest/gtest.h>

namespace deixis::scene {
namespace {

constexpr Box kBox{10.0, 20.0, 30.0, 40.0};

TEST(Box, CentreLiesHalfWay) { EXPECT_EQ(Centre(kBox), Eigen::Vector2d(25.0, 40.0)); }

TEST(Box, DistanceIsZeroInside) { EXPECT_EQ(DistanceTo(kBox, {25.0, 59.0}), 0.0); }

TEST(Box, DistanceIsMeasuredToTheNearestEdgeOrCorner) {
  EXPECT_DOUBLE_EQ(DistanceTo(kBox, {45.0, 30.0}), 5.0);
  EXPECT_DOUBLE_EQ(DistanceTo(kBox, {7.0, 16.0}), 5.0);
}

TEST(Box, OverlapIsOneForItselfAndZeroApart) {
  EXPECT_DOUBLE_EQ(Overlap(kBox, kBox), 1.0);
  EXPECT_DOUBLE_EQ(Overlap(kBox, {100.0, 100.0, 5.0, 5.0}), 0.0);
  EXPECT_DOUBLE_EQ(Overlap(kBox, {25.0, 20.0, 30.0, 40.0}), 1.0 / 3.0);
}

}  // namespace
}  // namespace deixis::scene
