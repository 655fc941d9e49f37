#pragma once
#include <cmath>

namespace deixis::skin {

/// A colour in which light and shade only shift the third coordinate: ratios of the channels say
/// what a surface is, the luminance how much light falls on it.
struct LogChromaticity {
  double red_green = 0.0;   ///< ln(R / G), R and G in 0..255.
  double green_blue = 0.0;  ///< ln(G / B).
  double luminance = 0.0;   ///< ln of the brightness.
};

/// The offset keeps dark pixels, whose ratios are noise, near neutral.
inline LogChromaticity ToLogChromaticity(double blue, double green, double red) {
  constexpr double kOffset = 6.0;
  const double b = blue + kOffset;
  const double g = green + kOffset;
  const double r = red + kOffset;
  return {std::log(r / g), std::log(g / b), std::log(0.25 * (r + 2.0 * g + b))};
}

}  // namespace deixis::skin
