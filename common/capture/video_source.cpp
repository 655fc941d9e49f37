#include "common/capture/video_source.h"

#include <cmath>
#include <filesystem>
#include <opencv2/videoio/registry.hpp>
#include <utility>

namespace deixis::capture {
namespace {

constexpr double kUsualRate_hz = 30.0;  // Where a file states no rate at all.
constexpr double kLongest_s = 1e9;      // A later time in a file is damage.
constexpr int kMaxDamagedInARow = 30;   // Then the rest of the file counts as lost.

// FFmpeg where it is there: trying the others in turn takes long and loads all of GStreamer.
int FileBackend() {
  return cv::videoio_registry::hasBackend(cv::CAP_FFMPEG) ? cv::CAP_FFMPEG : cv::CAP_ANY;
}

cv::VideoCapture Open(const SourceConfig& config) {
  const std::string& path = config.path;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    throw config::ConfigError("video file '" + path + "' does not exist; set " + config.key +
                              ".path to an existing file");
  }
  cv::VideoCapture video(path, FileBackend());
  if (!video.isOpened()) {
    throw config::ConfigError("video file '" + path + "' cannot be opened; set " + config.key +
                              ".path to a video that OpenCV can read (AVI, MP4, MKV)");
  }
  return video;
}

double PeriodOf(const cv::VideoCapture& video, double rate_hz) {
  if (rate_hz > 0.0) return 1.0 / rate_hz;
  const double stated_hz = video.get(cv::CAP_PROP_FPS);
  return 1.0 / (stated_hz >= kLowestRate_hz && stated_hz < 1000.0 ? stated_hz : kUsualRate_hz);
}

}  // namespace

VideoSource::VideoSource(const SourceConfig& config)
    : path_(config.path),
      video_(Open(config)),
      keeps_file_times_(config.rate_hz <= 0.0),
      period_s_(PeriodOf(video_, config.rate_hz)),
      stated_pictures_(video_.get(cv::CAP_PROP_FRAME_COUNT)) {}

Grab VideoSource::Next() {
  Picture picture;
  if (!ReadPastDamage(picture.bgr)) return {SourceState::kFinished, std::nullopt};
  picture.time = TimeOfThisPicture();
  picture.period_s = period_s_;
  ++pictures_;
  return {SourceState::kPicture, std::move(picture)};
}

SourceStatus VideoSource::status() const {
  SourceStatus status;
  status.corrupt = corrupt_;
  status.last_corrupt = last_corrupt_;
  return status;
}

bool VideoSource::ReadPastDamage(cv::Mat& bgr) {
  for (int damaged = 0; damaged < kMaxDamagedInARow; ++damaged) {
    if (video_.read(bgr) && !bgr.empty()) return true;
    // Short of the stated number of pictures this is damage, not the end.
    if (static_cast<double>(pictures_ + corrupt_) >= stated_pictures_) {
      if (damaged > 0) CountAsCut(damaged);
      return false;
    }
    ++corrupt_;
    ++damaged_since_last_;
    last_corrupt_ = path_;
  }
  CountAsCut(kMaxDamagedInARow);
  return false;
}

// That is one fault, not as many as there were tries.
void VideoSource::CountAsCut(int tries) {
  corrupt_ -= tries - 1;
  last_corrupt_ = path_ + ", which ends after " + std::to_string(pictures_) + " of " +
                  std::to_string(std::llround(stated_pictures_)) + " pictures";
}

Timestamp VideoSource::TimeOfThisPicture() {
  const double file_time_s = 1e-3 * video_.get(cv::CAP_PROP_POS_MSEC);
  if (pictures_ == 0) {
    first_file_time_s_ = file_time_s;
    damaged_since_last_ = 0;
    return {};
  }
  const double own_time_s = file_time_s - first_file_time_s_;
  const bool is_usable = keeps_file_times_ && own_time_s > last_time_s_ && own_time_s <= kLongest_s;
  last_time_s_ = is_usable ? own_time_s : last_time_s_ + (1 + damaged_since_last_) * period_s_;
  damaged_since_last_ = 0;
  return {std::llround(1e6 * last_time_s_)};
}

}  // namespace deixis::capture
