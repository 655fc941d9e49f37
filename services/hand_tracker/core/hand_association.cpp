#include "services/hand_tracker/core/hand_association.h"

#include <algorithm>
#include <cmath>

namespace deixis::hand_tracker {
namespace {

constexpr double kHuge = 1e12;

/// One column more per row, in which the row stays unassigned; forbidden pairs become very dear.
Eigen::MatrixXd WithDummies(const Eigen::MatrixXd& costs, double unassigned_cost) {
  const Eigen::Index rows = costs.rows();
  Eigen::MatrixXd all = Eigen::MatrixXd::Constant(rows, costs.cols() + rows, kHuge);
  for (Eigen::Index r = 0; r < rows; ++r) {
    for (Eigen::Index c = 0; c < costs.cols(); ++c) {
      if (std::isfinite(costs(r, c))) all(r, c) = costs(r, c);
    }
    all(r, costs.cols() + r) = unassigned_cost;
  }
  return all;
}

/// Shortest augmenting paths over a matrix with at least as many columns as rows. Indices from 1, 0
/// is the free column from which each row's path starts.
class ShortestPaths {
 public:
  explicit ShortestPaths(const Eigen::MatrixXd& costs)
      : costs_(costs),
        row_price_(static_cast<std::size_t>(costs.rows()) + 1, 0.0),
        column_price_(static_cast<std::size_t>(costs.cols()) + 1, 0.0),
        row_of_(static_cast<std::size_t>(costs.cols()) + 1, 0) {
    for (int row = 1; row <= costs.rows(); ++row) Augment(row);
  }

  /// Row (from 1) of each column (from 1), 0 = none.
  const std::vector<int>& row_of() const { return row_of_; }

 private:
  void Augment(int row) {
    const std::size_t n = column_price_.size();
    row_of_[0] = row;
    shortest_.assign(n, kForbidden);
    previous_.assign(n, 0);
    is_done_.assign(n, false);
    std::size_t column = 0;
    do {
      column = Extend(column);
    } while (row_of_[column] != 0);
    while (column != 0) {
      row_of_[column] = row_of_[previous_[column]];
      column = previous_[column];
    }
  }

  /// Settles `column` and returns the nearest column that is not settled.
  std::size_t Extend(std::size_t column) {
    is_done_[column] = true;
    const auto row = static_cast<std::size_t>(row_of_[column]);
    double delta = kForbidden;
    std::size_t next = 0;
    for (std::size_t j = 1; j < column_price_.size(); ++j) {
      if (is_done_[j]) continue;
      const double reduced =
          costs_(static_cast<Eigen::Index>(row) - 1, static_cast<Eigen::Index>(j) - 1) -
          row_price_[row] - column_price_[j];
      if (reduced < shortest_[j]) {
        shortest_[j] = reduced;
        previous_[j] = column;
      }
      if (shortest_[j] < delta) {
        delta = shortest_[j];
        next = j;
      }
    }
    Reprice(delta);
    return next;
  }

  void Reprice(double delta) {
    for (std::size_t j = 0; j < column_price_.size(); ++j) {
      if (is_done_[j]) {
        row_price_[static_cast<std::size_t>(row_of_[j])] += delta;
        column_price_[j] -= delta;
      } else {
        shortest_[j] -= delta;
      }
    }
  }

  const Eigen::MatrixXd& costs_;
  std::vector<double> row_price_;
  std::vector<double> column_price_;
  std::vector<int> row_of_;
  std::vector<double> shortest_;
  std::vector<std::size_t> previous_;
  std::vector<bool> is_done_;
};

}  // namespace

std::vector<int> Assign(const Eigen::MatrixXd& costs, double unassigned_cost) {
  const Eigen::MatrixXd all = WithDummies(costs, unassigned_cost);
  const ShortestPaths paths(all);
  std::vector<int> column_of(static_cast<std::size_t>(costs.rows()), -1);
  for (int column = 1; column <= costs.cols(); ++column) {
    const int row = paths.row_of()[static_cast<std::size_t>(column)];
    if (row == 0) continue;
    const bool is_allowed = std::isfinite(costs(row - 1, column - 1));
    if (is_allowed) column_of[static_cast<std::size_t>(row) - 1] = column - 1;
  }
  return column_of;
}

}  // namespace deixis::hand_tracker
