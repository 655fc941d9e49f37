#pragma once
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <stdexcept>
#include <string>

#include "common/scene/gesture.h"
#include "common/time/timestamp.h"

namespace deixis::viewer {

/// A picture that is lost. The message says which and what to do.
class PictureNotWritten : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes pictures to a folder: one per gesture, the latest one, and some that are kept. A picture
/// that cannot be written whole leaves nothing behind and throws PictureNotWritten.
class PictureFiles {
 public:
  /// Throws ConfigError when the folder cannot be made.
  explicit PictureFiles(const std::filesystem::path& folder);

  /// gesture_<event>_<label>_<time in microseconds>.png
  void WriteGesture(const scene::Gesture& gesture, const cv::Mat& bgr) const;
  /// latest.png, replaced in one step, so that a reader never sees half a picture.
  void WriteLatest(const cv::Mat& bgr) const;
  /// picture_<time in microseconds>.png
  void WriteStill(Timestamp time, const cv::Mat& bgr) const;

 private:
  void Write(const std::string& name, const cv::Mat& bgr) const;

  std::filesystem::path folder_;
};

}  // namespace deixis::viewer
