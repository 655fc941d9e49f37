#include "services/hand_tracker/core/hand_association.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace deixis::hand_tracker {
namespace {

TEST(Assign, TakesTheBestSumRatherThanTheBestPair) {
  Eigen::MatrixXd costs(2, 2);
  costs << 1.0, 2.0, 2.0, 10.0;
  EXPECT_EQ(Assign(costs, 100.0), (std::vector<int>{1, 0}));
}

TEST(Assign, LeavesOutWhatCostsTooMuch) {
  Eigen::MatrixXd costs(2, 1);
  costs << 5.0, 50.0;
  EXPECT_EQ(Assign(costs, 20.0), (std::vector<int>{0, -1}));
}

TEST(Assign, NeverTakesForbiddenPairs) {
  Eigen::MatrixXd costs(2, 2);
  costs << kForbidden, 3.0, kForbidden, 4.0;
  EXPECT_EQ(Assign(costs, 1e6), (std::vector<int>{1, -1}));
}

TEST(Assign, AcceptsNoRowsAndNoColumns) {
  EXPECT_TRUE(Assign(Eigen::MatrixXd(0, 3), 1.0).empty());
  EXPECT_EQ(Assign(Eigen::MatrixXd(2, 0), 1.0), (std::vector<int>{-1, -1}));
}

double CostOf(const Eigen::MatrixXd& costs, const std::vector<int>& columns, double unassigned) {
  double sum = 0.0;
  for (std::size_t row = 0; row < columns.size(); ++row) {
    sum += columns[row] < 0 ? unassigned : costs(static_cast<Eigen::Index>(row), columns[row]);
  }
  return sum;
}

TEST(Assign, IsAsGoodAsTryingAllPermutations) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> cost(0.0, 10.0);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::MatrixXd costs = Eigen::MatrixXd::NullaryExpr(4, 4, [&] { return cost(random); });
    std::vector<int> order = {0, 1, 2, 3};
    double best = kForbidden;
    do {
      double sum = 0.0;
      for (int row = 0; row < 4; ++row) {
        sum += std::min(6.0, costs(row, order[static_cast<std::size_t>(row)]));
      }
      best = std::min(best, sum);
    } while (std::next_permutation(order.begin(), order.end()));
    EXPECT_NEAR(CostOf(costs, Assign(costs, 6.0), 6.0), best, 1e-9);
  }
}

}  // namespace
}  // namespace deixis::hand_tracker
