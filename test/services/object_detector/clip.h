#pragma once
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <vector>

namespace deixis::object_detector {

/// The first pictures of the test clip: a man faces the camera, his nose at kNose.
inline std::vector<cv::Mat> ClipPictures(std::size_t count) {
  cv::VideoCapture video(DEIXIS_SOURCE_DIR "/test/data/clips/spread_01/left.mp4");
  std::vector<cv::Mat> pictures;
  cv::Mat bgr;
  while (pictures.size() < count && video.read(bgr)) pictures.push_back(bgr.clone());
  return pictures;
}

inline cv::Mat Grey(const cv::Mat& bgr) {
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

inline const cv::Point2d kNose(321, 81);

}  // namespace deixis::object_detector
