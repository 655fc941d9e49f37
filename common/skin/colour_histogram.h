#pragma once
#include <array>
#include <cstddef>

#include "common/skin/log_chromaticity.h"

namespace deixis::skin {

/// Density of colours over ln(R/G) and ln(G/B): a histogram that forgets.
class ColourHistogram {
 public:
  static constexpr int kBins = 40;               ///< Per axis.
  static constexpr double kRedGreenMin = -0.8;   ///< Lower edge of ln(R/G).
  static constexpr double kGreenBlueMin = -0.8;  ///< Lower edge of ln(G/B).
  static constexpr double kBinWidth = 0.06;

  /// Counts a colour with `weight`; what lies outside is counted in the outermost bin.
  void Add(const LogChromaticity& colour, double weight);

  /// Blurs by one bin, then scales so that the densities integrate to 1. Empty stays empty.
  void SmoothAndNormalise();

  /// Moves towards `newer` by `share` (0..1); an empty histogram becomes `newer` at once.
  void BlendTowards(const ColourHistogram& newer, double share);

  /// Per unit of the two logarithms, interpolated between bins.
  double Density(const LogChromaticity& colour) const;

  bool is_empty() const { return total_ <= 0.0; }

 private:
  double At(int row, int column) const;

  std::array<double, static_cast<std::size_t>(kBins) * kBins> density_{};
  double total_ = 0.0;
};

}  // namespace deixis::skin
