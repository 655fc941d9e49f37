#include "common/filtering/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace deixis::filtering {
namespace {

TEST(CounterRandom, IsAFunctionOfItsArguments) {
  EXPECT_EQ(CounterRandom(1, 2).Bits(3), CounterRandom(1, 2).Bits(3));
  EXPECT_NE(CounterRandom(1, 2).Bits(3), CounterRandom(1, 2).Bits(4));
  EXPECT_NE(CounterRandom(1, 2).Bits(3), CounterRandom(1, 3).Bits(3));
  EXPECT_NE(CounterRandom(1, 2).Bits(3), CounterRandom(2, 2).Bits(3));
}

TEST(CounterRandom, UniformNumbersFillTheUnitInterval) {
  const CounterRandom random(4, 0);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kCount = 100000;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const double value = static_cast<double>(random.Uniform(i));
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / kCount, 0.5, 0.005);
  EXPECT_NEAR(squares / kCount, 1.0 / 3.0, 0.005);
}

TEST(CounterRandom, NormalNumbersHaveMeanZeroAndVarianceOne) {
  const CounterRandom random(4, 1);
  double sum = 0.0;
  double squares = 0.0;
  double fourth = 0.0;
  constexpr int kCount = 200000;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const double value = static_cast<double>(random.Normal(i));
    sum += value;
    squares += value * value;
    fourth += value * value * value * value;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.01);
  EXPECT_NEAR(squares / kCount, 1.0, 0.01);
  EXPECT_NEAR(fourth / kCount, 2.7, 0.05);  // Four uniform numbers: 3 - 1.2 / 4.
}

TEST(CounterRandom, NeighbouringCountersAreNotCorrelated) {
  const CounterRandom random(11, 0);
  double product = 0.0;
  constexpr int kCount = 100000;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    product += static_cast<double>(random.Normal(i) * random.Normal(i + 1));
  }
  EXPECT_NEAR(product / kCount, 0.0, 0.015);
}

}  // namespace
}  // namespace deixis::filtering
