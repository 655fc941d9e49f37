#include "common/skin/colour_histogram.h"

#include <gtest/gtest.h>

namespace deixis::skin {
namespace {

constexpr LogChromaticity kSkin{0.35, 0.25, 5.0};
constexpr LogChromaticity kBlue{-0.4, -0.5, 4.0};

ColourHistogram HistogramOf(const LogChromaticity& colour) {
  ColourHistogram histogram;
  histogram.Add(colour, 1.0);
  histogram.SmoothAndNormalise();
  return histogram;
}

TEST(ColourHistogram, IsDenseWhereColoursWereCounted) {
  const ColourHistogram histogram = HistogramOf(kSkin);
  EXPECT_GT(histogram.Density(kSkin), 1.0);
  EXPECT_DOUBLE_EQ(histogram.Density(kBlue), 0.0);
}

TEST(ColourHistogram, IntegratesToOne) {
  const ColourHistogram histogram = HistogramOf(kSkin);
  double mass = 0.0;
  constexpr double kStep = ColourHistogram::kBinWidth / 3.0;
  for (double a = -0.8; a < 1.6; a += kStep) {
    for (double b = -0.8; b < 1.6; b += kStep) {
      mass += histogram.Density({a, b, 0.0}) * kStep * kStep;
    }
  }
  EXPECT_NEAR(mass, 1.0, 0.01);
}

TEST(ColourHistogram, ForgetsWhatItIsBlendedAwayFrom) {
  ColourHistogram histogram = HistogramOf(kSkin);
  const double before = histogram.Density(kSkin);
  histogram.BlendTowards(HistogramOf(kBlue), 0.75);
  EXPECT_NEAR(histogram.Density(kSkin), 0.25 * before, 1e-9);
}

TEST(ColourHistogram, TakesTheFirstOneWhole) {
  ColourHistogram histogram;
  histogram.BlendTowards(HistogramOf(kSkin), 0.1);
  EXPECT_DOUBLE_EQ(histogram.Density(kSkin), HistogramOf(kSkin).Density(kSkin));
}

TEST(ColourHistogram, StaysEmptyWithoutColours) {
  ColourHistogram histogram;
  histogram.SmoothAndNormalise();
  EXPECT_TRUE(histogram.is_empty());
  EXPECT_DOUBLE_EQ(histogram.Density(kSkin), 0.0);
}

}  // namespace
}  // namespace deixis::skin
