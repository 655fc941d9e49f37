#pragma once
#include <Eigen/Core>
#include <limits>
#include <vector>

namespace deixis::hand_tracker {

/// A pair that must not be.
inline constexpr double kForbidden = std::numeric_limits<double>::infinity();

/// Assigns rows to columns, each at most once, so that as many costs as `unassigned_cost` makes
/// worth it are taken and their sum is least (Hungarian method, Kuhn 1955; Jonker and Volgenant's
/// shortest augmenting paths). Leaving a row out costs `unassigned_cost`. Returns a column per row,
/// -1 = none.
std::vector<int> Assign(const Eigen::MatrixXd& costs, double unassigned_cost);

}  // namespace deixis::hand_tracker
