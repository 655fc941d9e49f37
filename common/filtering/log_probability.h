#pragma once
#include <cmath>
#include <limits>

namespace deixis::filtering {

constexpr double kTwoPi = 6.28318530717958647692;
constexpr double kImpossible = -std::numeric_limits<double>::infinity();

/// log(e^a + e^b).
inline double LogAdd(double a, double b) {
  const double high = a > b ? a : b;
  if (high == kImpossible) return kImpossible;
  return high + std::log1p(std::exp((a > b ? b : a) - high));
}

inline double LogNormal(double deviation, double sigma) {
  const double ratio = deviation / sigma;
  return -0.5 * ratio * ratio - std::log(sigma) - 0.5 * std::log(kTwoPi);
}

/// Isotropic normal density in the plane at `distance` from its mean.
inline double LogPlaneNormal(double distance, double sigma) {
  const double ratio = distance / sigma;
  return -0.5 * ratio * ratio - std::log(kTwoPi * sigma * sigma);
}

}  // namespace deixis::filtering
