#pragma once
#include <vector>

namespace deixis::calibrator {

/// The middle one of `values`, of an even number the upper one of two; 0 of nothing.
double Median(std::vector<double> values);

}  // namespace deixis::calibrator
