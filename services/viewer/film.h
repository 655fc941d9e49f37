#pragma once
#include <filesystem>
#include <opencv2/videoio.hpp>

namespace deixis::viewer {

/// Writes pictures of one size into a film: MP4, MPEG-4 part 2, which players know everywhere.
class Film {
 public:
  /// Replaces what is there. Throws ConfigError where no file can be made.
  Film(const std::filesystem::path& file, double rate_hz);

  /// The first one says the size. Throws PictureNotWritten when there is no codec, or the size is
  /// another one.
  void Add(const cv::Mat& bgr);

 private:
  std::filesystem::path file_;
  double rate_hz_;
  cv::Size size_;
  cv::VideoWriter writer_;
};

}  // namespace deixis::viewer
