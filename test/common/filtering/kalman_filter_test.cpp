#include "common/filtering/kalman_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace deixis::filtering {
namespace {

constexpr double kStep_s = 1.0 / 30.0;

ConstantAccelerationFilter NewFilter(double decay_s = 0.0) {
  return {{1e4, decay_s}, {0.0, 0.0, 0.0}, {100.0, 1000.0, 1000.0}};
}

TEST(ConstantAccelerationFilter, FollowsAParabolaWithoutLag) {
  auto filter = NewFilter();
  double t = 0.0;
  for (int i = 0; i < 60; ++i) {
    t += kStep_s;
    filter.Predict(kStep_s);
    filter.Update(10.0 + 20.0 * t + 15.0 * t * t, 0.5);
  }
  EXPECT_NEAR(filter.position(), 10.0 + 20.0 * t + 15.0 * t * t, 0.05);
  EXPECT_NEAR(filter.velocity(), 20.0 + 30.0 * t, 0.5);
  EXPECT_NEAR(filter.acceleration(), 30.0, 3.0);
}

TEST(ConstantAccelerationFilter, TwoHalfStepsEqualOneStep) {
  for (const double decay_s : {0.0, 0.2}) {
    ConstantAccelerationFilter once({50.0, decay_s}, {1.0, 2.0, 3.0}, {1.0, 1.0, 1.0});
    auto twice = once;
    once.Predict(0.2);
    twice.Predict(0.1);
    twice.Predict(0.1);
    EXPECT_NEAR(once.position(), twice.position(), 1e-12);
    EXPECT_NEAR(once.velocity(), twice.velocity(), 1e-12);
    // The added noise is exact for constant acceleration only.
    if (decay_s == 0.0) {
      EXPECT_TRUE(once.covariance().isApprox(twice.covariance(), 1e-12));
    }
  }
}

TEST(ConstantAccelerationFilter, SpreadAgreesWithTheErrors) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 1.0);
  double sum = 0.0;
  constexpr int kRuns = 400;
  for (int run = 0; run < kRuns; ++run) {
    Eigen::Vector3d truth(noise(random), noise(random), noise(random));
    ConstantAccelerationFilter filter({4.0, 0.0}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
    for (int i = 0; i < 40; ++i) {
      constexpr double t = 0.05;
      truth[0] += t * truth[1] + 0.5 * t * t * truth[2];
      truth[1] += t * truth[2];
      truth[2] += std::sqrt(4.0 * t) * noise(random);
      filter.Predict(t);
      filter.Update(truth[0] + 0.3 * noise(random), 0.3);
    }
    const Eigen::Vector3d error(filter.position() - truth[0], filter.velocity() - truth[1],
                                filter.acceleration() - truth[2]);
    sum += error.dot(filter.covariance().inverse() * error);
  }
  EXPECT_NEAR(sum / kRuns, 3.0, 0.45);  // Normalised squared error of three degrees of freedom.
}

TEST(ConstantAccelerationFilter, AccelerationDiesAwayWhenAskedTo) {
  ConstantAccelerationFilter filter({1.0, 0.1}, {0.0, 0.0, 100.0}, {1.0, 1.0, 1.0});
  filter.Predict(2.0);
  EXPECT_NEAR(filter.acceleration(), 0.0, 1e-6);
  EXPECT_NEAR(filter.velocity(), 10.0, 1e-6);
}

TEST(ConstantAccelerationFilter, SlowingDownKeepsThePlace) {
  ConstantAccelerationFilter filter({1.0, 0.0}, {5.0, 8.0, 2.0}, {1.0, 1.0, 1.0});
  filter.Slow(0.5);
  EXPECT_DOUBLE_EQ(filter.position(), 5.0);
  EXPECT_DOUBLE_EQ(filter.velocity(), 4.0);
  EXPECT_DOUBLE_EQ(filter.acceleration(), 1.0);
}

TEST(ConstantAccelerationFilter, StaysFiniteAndPositiveOverManySteps) {
  auto filter = NewFilter(0.25);
  for (int i = 0; i < 20000; ++i) {
    filter.Predict(i % 7 == 0 ? 0.0 : kStep_s);
    if (i % 3 == 0) filter.Update(1e4 * std::sin(0.01 * i), 0.01);
  }
  EXPECT_TRUE(filter.covariance().allFinite());
  EXPECT_GT(filter.covariance().selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.0);
}

}  // namespace
}  // namespace deixis::filtering
