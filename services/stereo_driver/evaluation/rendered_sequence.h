#pragma once
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <opencv2/videoio.hpp>
#include <optional>
#include <set>

#include "common/images/stereo_pair.h"

namespace deixis::stereo_driver {

/// One frame whose truth is known.
struct TrueFrame {
  int number = 0;
  images::StereoPair pair;
  cv::Mat depth_mm;  ///< CV_16UC1, z of the raw left camera, on its pixels; 0 = not known.
  cv::Mat is_body;   ///< CV_8UC1, 255 where a person is seen.
};

/// A folder with left.mp4, right.mp4, depth/NNNNNN.png (people and loose objects), depth/room.png
/// (behind them) and mask/NNNNNN.png.
class RenderedSequence {
 public:
  /// Uses every `every`-th of the frames that have a truth. Throws ConfigError naming what cannot
  /// be read.
  RenderedSequence(const std::filesystem::path& folder, int every);

  std::size_t frame_count() const { return frames_.size(); }
  /// Frames in order; nothing at the end. Throws ConfigError.
  std::optional<TrueFrame> Next();

 private:
  cv::Mat ReadPicture(const std::string& name, int type) const;

  std::filesystem::path folder_;
  std::set<int> frames_;  ///< Those that are wanted.
  cv::VideoCapture left_, right_;
  cv::Mat room_mm_;
  int next_number_ = 0;
};

}  // namespace deixis::stereo_driver
