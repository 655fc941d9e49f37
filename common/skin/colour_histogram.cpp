#include "common/skin/colour_histogram.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace deixis::skin {
namespace {

std::size_t Index(int row, int column) {
  const int r = std::clamp(row, 0, ColourHistogram::kBins - 1);
  const int c = std::clamp(column, 0, ColourHistogram::kBins - 1);
  return static_cast<std::size_t>(r * ColourHistogram::kBins + c);
}

double RowOf(const LogChromaticity& colour) {
  return (colour.red_green - ColourHistogram::kRedGreenMin) / ColourHistogram::kBinWidth;
}

double ColumnOf(const LogChromaticity& colour) {
  return (colour.green_blue - ColourHistogram::kGreenBlueMin) / ColourHistogram::kBinWidth;
}

}  // namespace

void ColourHistogram::Add(const LogChromaticity& colour, double weight) {
  const int row = static_cast<int>(std::floor(RowOf(colour)));
  const int column = static_cast<int>(std::floor(ColumnOf(colour)));
  density_[Index(row, column)] += weight;
  total_ += weight;
}

void ColourHistogram::SmoothAndNormalise() {
  if (is_empty()) return;
  const auto source = density_;
  const auto value = [&source](int row, int column) { return source[Index(row, column)]; };
  for (int row = 0; row < kBins; ++row) {
    for (int column = 0; column < kBins; ++column) {
      double sum = 0.0;
      for (int dr = -1; dr <= 1; ++dr) {
        for (int dc = -1; dc <= 1; ++dc) {
          sum += value(row + dr, column + dc) * (2 - std::abs(dr)) * (2 - std::abs(dc));
        }
      }
      density_[Index(row, column)] = sum;
    }
  }
  const double mass = std::accumulate(density_.begin(), density_.end(), 0.0);
  const double scale = 1.0 / (mass * kBinWidth * kBinWidth);
  for (double& density : density_) density *= scale;
  total_ = 1.0;
}

void ColourHistogram::BlendTowards(const ColourHistogram& newer, double share) {
  if (newer.is_empty()) return;
  const double weight = is_empty() ? 1.0 : std::clamp(share, 0.0, 1.0);
  for (std::size_t i = 0; i < density_.size(); ++i) {
    density_[i] += weight * (newer.density_[i] - density_[i]);
  }
  total_ = 1.0;
}

double ColourHistogram::At(int row, int column) const { return density_[Index(row, column)]; }

double ColourHistogram::Density(const LogChromaticity& colour) const {
  const double row = RowOf(colour) - 0.5;
  const double column = ColumnOf(colour) - 0.5;
  const int r = static_cast<int>(std::floor(row));
  const int c = static_cast<int>(std::floor(column));
  const double fr = row - r;
  const double fc = column - c;
  return (1.0 - fr) * ((1.0 - fc) * At(r, c) + fc * At(r, c + 1)) +
         fr * ((1.0 - fc) * At(r + 1, c) + fc * At(r + 1, c + 1));
}

}  // namespace deixis::skin
