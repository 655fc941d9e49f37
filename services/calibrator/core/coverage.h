#pragma once
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "services/calibrator/core/view.h"

namespace deixis::calibrator {

inline constexpr int kCoverageColumns = 8;
inline constexpr int kCoverageRows = 6;

/// Where in the picture, how large and how tilted the board has been so far, for one camera.
class Coverage {
 public:
  void Add(const View& view);

  /// Share of the picture's 8 x 6 cells in which corners were seen, 0..1.
  double share() const;
  double largest_tilt_deg() const;  ///< Rough, as the views' own.
  int corners_in(int column, int row) const;
  /// What the next view should show, the most needed first; empty when nothing is missing.
  std::vector<std::string> Advice() const;

 private:
  bool IsEmpty(cv::Rect cells) const;
  void AdvisePlace(std::vector<std::string>& advice) const;
  void AdviseTilt(std::vector<std::string>& advice) const;

  std::vector<int> cells_ = std::vector<int>(kCoverageColumns * kCoverageRows, 0);
  int views_ = 0;
  double smallest_extent_ = 1.0;
  double largest_extent_ = 0.0;
  double most_right_deg_ = 0.0;
  double most_left_deg_ = 0.0;
  double most_down_deg_ = 0.0;
  double most_up_deg_ = 0.0;
};

}  // namespace deixis::calibrator
