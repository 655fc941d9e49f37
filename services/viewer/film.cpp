#include "services/viewer/film.h"

#include <fstream>

#include "common/config/config.h"
#include "services/viewer/picture_files.h"

namespace deixis::viewer {

Film::Film(const std::filesystem::path& file, double rate_hz) : file_(file), rate_hz_(rate_hz) {
  const std::ofstream probe(file_, std::ios::binary);
  if (probe) return;
  throw config::ConfigError("film '" + file_.string() +
                            "' cannot be made; set film to a file that can be written");
}

void Film::Add(const cv::Mat& bgr) {
  if (size_.empty()) {
    size_ = bgr.size();
    writer_.open(file_.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('m', 'p', '4', 'v'),
                 rate_hz_, size_);
  }
  if (!writer_.isOpened()) {
    throw PictureNotWritten("film '" + file_.string() +
                            "' cannot be written: it must end with .mp4, and OpenCV have FFmpeg");
  }
  if (bgr.size() != size_) {
    throw PictureNotWritten("film '" + file_.string() +
                            "': a picture of another size than the first is left out");
  }
  writer_.write(bgr);
}

}  // namespace deixis::viewer
