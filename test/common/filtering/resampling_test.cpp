#include "common/filtering/resampling.h"

#include <gmock/gmock.h>

#include <limits>
#include <numeric>

#include "common/filtering/random.h"

namespace deixis::filtering {
namespace {

using testing::Each;
using testing::ElementsAre;

std::vector<int> CountsOf(const std::vector<int>& ancestors, std::size_t sources) {
  std::vector<int> counts(sources, 0);
  for (const int ancestor : ancestors) ++counts[static_cast<std::size_t>(ancestor)];
  return counts;
}

const std::vector<float> kWeights{0.05F, 0.0F, 0.45F, 0.2F, 0.3F};

TEST(Resampling, IsUnbiased) {
  constexpr int kRuns = 20000;
  const CounterRandom random(3, 1);
  std::vector<int> ancestors(7);
  std::vector<double> mean(kWeights.size(), 0.0);
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    ASSERT_TRUE(ResampleSystematically(kWeights, random.Uniform(run), ancestors));
    const auto counts = CountsOf(ancestors, kWeights.size());
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += counts[i] / double{kRuns};
  }
  for (std::size_t i = 0; i < mean.size(); ++i) {
    EXPECT_NEAR(mean[i], 7.0 * static_cast<double>(kWeights[i]), 0.02) << "weight " << i;
  }
}

TEST(Resampling, CountsDifferFromTheirShareByLessThanOne) {
  const CounterRandom random(9, 0);
  std::vector<int> ancestors(1000);
  for (std::uint64_t run = 0; run < 50; ++run) {
    ASSERT_TRUE(ResampleSystematically(kWeights, random.Uniform(run), ancestors));
    const auto counts = CountsOf(ancestors, kWeights.size());
    for (std::size_t i = 0; i < counts.size(); ++i) {
      EXPECT_LT(std::abs(counts[i] - 1000.0 * static_cast<double>(kWeights[i])), 1.001);
    }
  }
}

TEST(Resampling, WeightsNeedNotSumToOne) {
  std::vector<int> ancestors(4);
  ASSERT_TRUE(ResampleSystematically({200.0F, 600.0F}, 0.5F, ancestors));
  EXPECT_THAT(ancestors, ElementsAre(0, 1, 1, 1));
}

TEST(Resampling, RefusesWeightsThatSayNothing) {
  std::vector<int> ancestors(3, 7);
  EXPECT_FALSE(ResampleSystematically({0.0F, 0.0F}, 0.5F, ancestors));
  EXPECT_FALSE(ResampleSystematically({std::numeric_limits<float>::quiet_NaN()}, 0.5F, ancestors));
  EXPECT_THAT(ancestors, Each(7));
}

}  // namespace
}  // namespace deixis::filtering
