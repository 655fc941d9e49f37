#pragma once
#include <opencv2/objdetect.hpp>
#include <string>
#include <vector>

#include "common/scene/box.h"

namespace deixis::object_detector {

/// Where a cascade answered, pixels of the picture that it was shown.
struct CascadeHit {
  scene::Box box;
  int neighbours = 0;  ///< How many places and sizes close by answered too.
};

/// A trained cascade (Viola and Jones 2001) with results that do not depend on the number of
/// threads: OpenCV returns rectangles in the order in which its threads end, so they are sorted
/// here.
class Cascade {
 public:
  /// `file`: a path, or a name that is searched for in `folders`, then under config/. Throws
  /// ConfigError with the cure.
  Cascade(const std::string& file, const std::vector<std::string>& folders);

  cv::Size window() const { return window_; }  ///< Smallest object that it can see.

  /// Every answer at the window's own size, on a grid of two pixels.
  std::vector<scene::Box> AnswersAtWindowSize(const cv::Mat& grey);

  /// Objects whose height lies in the given range, answers that agree taken together, those with
  /// fewer than `min_neighbours` left out; most neighbours first.
  std::vector<CascadeHit> Find(const cv::Mat& grey, double min_height_px, double max_height_px,
                               double scale_step, int min_neighbours);

 private:
  cv::CascadeClassifier classifier_;
  cv::Size window_;
};

}  // namespace deixis::object_detector
