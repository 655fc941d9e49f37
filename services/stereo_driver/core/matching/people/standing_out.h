#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "services/stereo_driver/core/matching/depth.h"
#include "services/stereo_driver/core/matching/people/windows.h"

namespace deixis::stereo_driver {

/// Finds what stands before its surroundings and is of a person's size, by depth alone: where
/// people may be while nobody says where they are. Things of that size are found, too.
class StandingOut {
 public:
  /// Windows in pixels of the full-size picture, the tallest ones first, from half-size disparities
  /// (CV_16SC1, as of DisparityMatcher) with the `geometry` of half-size pictures.
  Windows Find(const cv::Mat& half_disparity, const DepthGeometry& geometry);

 private:
  void FillGrid(const cv::Mat& half_disparity, const DepthGeometry& geometry);
  void LeaveSurroundingsOut();
  void Flood(cv::Point start);
  void NoteColumns();
  /// What was flooded last becomes a window when it is of a person's size.
  void AddWindow(double focal_px);
  /// Of what is wider than a person, where it is nearly as tall as anywhere.
  cv::Range TallColumns(double cell_m) const;

  struct Cell {
    cv::Point place;
    float metres;
  };
  struct Candidate {
    cv::Rect window;
    int height = 0;
  };
  cv::Mat cell_m_;  ///< CV_32FC1, distance of each cell that stands out; 0 = of none.
  std::vector<int> samples_;
  std::vector<float> row_m_;
  std::vector<Cell> flooded_;       ///< Those that belong together.
  std::vector<cv::Range> columns_;  ///< Rows that they take in each column of cells.
  cv::Range taken_columns_;
  cv::Range taken_rows_;
  double distance_m_ = 0.0;
  std::vector<Candidate> candidates_;
};

}  // namespace deixis::stereo_driver
