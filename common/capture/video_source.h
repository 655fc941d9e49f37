#pragma once
#include <opencv2/videoio.hpp>

#include "common/capture/sources.h"

namespace deixis::capture {

/// A video file, every picture in order. Times are the file's own, from 0 at the first picture;
/// where it has none, or they do not grow (the last pictures of H.264 files come without), one
/// period after the picture before.
class VideoSource final : public Source {
 public:
  /// Throws ConfigError when the file cannot be opened.
  explicit VideoSource(const SourceConfig& config);

  Grab Next() override;
  SourceStatus status() const override;

 private:
  bool ReadPastDamage(cv::Mat& bgr);
  void CountAsCut(int tries);
  Timestamp TimeOfThisPicture();

  std::string path_;
  cv::VideoCapture video_;
  bool keeps_file_times_;
  double period_s_;
  double stated_pictures_;  ///< As the file's header has it; <= 0 = not stated.
  std::int64_t pictures_ = 0;
  std::int64_t corrupt_ = 0;
  std::string last_corrupt_;
  double first_file_time_s_ = 0.0;
  double last_time_s_ = 0.0;  ///< Of the last picture given, since the first one.
  int damaged_since_last_ = 0;
};

}  // namespace deixis::capture
