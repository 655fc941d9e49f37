#pragma once
#include <vector>

namespace deixis::filtering {

/// Systematic resampling (Kitagawa 1996): fills `ancestors` with indices into `weights`, ascending,
/// each as often as its share of the weight asks for, give or take one. Unbiased for `offset`
/// uniform in [0, 1). Weights need not sum to 1. Returns false, and changes nothing, when no weight
/// is positive.
bool ResampleSystematically(const std::vector<float>& weights, float offset,
                            std::vector<int>& ancestors);

}  // namespace deixis::filtering
