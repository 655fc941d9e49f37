#pragma once
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "common/scene/gesture.h"

namespace deixis::viewer {

/// Writes pictures to a folder: one per gesture, and the latest one. Throws ConfigError when the
/// folder cannot be made or written to.
class PictureFiles {
 public:
  explicit PictureFiles(const std::filesystem::path& folder);

  /// gesture_<event>_<label>_<time in microseconds>.png
  void WriteGesture(const scene::Gesture& gesture, const cv::Mat& bgr) const;
  /// latest.png, replaced in one step, so that a reader never sees half a picture.
  void WriteLatest(const cv::Mat& bgr) const;

 private:
  void Write(const std::string& name, const cv::Mat& bgr) const;

  std::filesystem::path folder_;
};

}  // namespace deixis::viewer
