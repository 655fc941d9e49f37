#include "services/stereo_driver/evaluation/depth_score.h"

#include <gtest/gtest.h>

#include "services/stereo_driver/evaluation/disparity_pair.h"

namespace deixis::stereo_driver {
namespace {

std::string Cell(const DepthScore& score, const std::string& column) {
  std::istringstream names(CsvHeading()), cells(CsvLine("name", "deixis", score));
  for (std::string name, cell; std::getline(names, name, ',') && std::getline(cells, cell, ',');) {
    if (name == column) return cell;
  }
  return "no such column";
}

TEST(DepthScore, CountsWhatIsMissingAndWhatIsBadAsLost) {
  DepthScore score;
  score.AddPixel(10.0, 10.5);
  score.AddPixel(10.0, 11.9);
  score.AddPixel(10.0, 12.1);
  score.AddPixel(10.0, std::nullopt);
  EXPECT_EQ(Cell(score, "valid_percent"), "75");
  EXPECT_EQ(Cell(score, "bad2px_percent"), "33.3333");
  EXPECT_EQ(Cell(score, "lost_percent"), "50");
  EXPECT_EQ(Cell(score, "bad2px_shared_percent"), "");
}

TEST(DepthScore, MeasuresDistancesInMetresByTheirTruth) {
  DepthScore score;
  score.AddPixel(30.0, 2.2, 2.21);
  EXPECT_NEAR(std::stod(Cell(score, "error_median_m")), 0.01, 1e-4);
  EXPECT_NEAR(std::stod(Cell(score, "error_median_m_2_to_2.5")), 0.01, 1e-4);
  EXPECT_EQ(Cell(score, "error_median_m_1.5_to_2"), "");
}

TEST(DepthScore, SharesOnlyWhatBothWaysHaveMeasured) {
  DisparityPair pair;
  pair.truth_px = (cv::Mat_<float>(1, 4) << 5.0F, 5.0F, 5.0F, 0.0F);
  const cv::Mat ours = (cv::Mat_<std::int16_t>(1, 4) << 80, 160, 160, 80);
  const cv::Mat others = (cv::Mat_<std::int16_t>(1, 4) << 80, 80, -16, 80);
  DepthScore score;
  Compare(pair, ours, others, score);
  EXPECT_EQ(score.truth, 3);
  EXPECT_EQ(score.bad, 2);
  EXPECT_EQ(Cell(score, "bad2px_shared_percent"), "50");
}

TEST(DepthScore, CountsPixelsBesideBodiesThatGotTheBodysDepth) {
  DepthScore score;
  const double body_m = 2.0, wall_m = 4.0;
  for (const double measured_m : {1.9, 2.0, 2.6, 2.7, 4.0}) {
    score.AddBesideBody(body_m, wall_m, measured_m);  // Half-way in disparity is 2.67 m.
  }
  score.AddBesideBody(body_m, wall_m, std::nullopt);
  EXPECT_EQ(score.beside, 6);
  EXPECT_EQ(score.fattened, 3);
  EXPECT_EQ(Cell(score, "fattened_percent"), "50");
}

}  // namespace
}  // namespace deixis::stereo_driver
