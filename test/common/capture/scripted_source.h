#pragma once
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "common/capture/source.h"

namespace deixis::capture {

/// A source that gives what it was told to.
class ScriptedSource final : public Source {
 public:
  explicit ScriptedSource(std::vector<Picture> pictures, SourceStatus status = {})
      : pictures_(std::move(pictures)), status_(std::move(status)) {}

  Grab Next() override {
    if (next_ == pictures_.size()) return {SourceState::kFinished, std::nullopt};
    return {SourceState::kPicture, pictures_[next_++]};
  }
  SourceStatus status() const override { return status_; }

 private:
  std::vector<Picture> pictures_;
  SourceStatus status_;
  std::size_t next_ = 0;
};

inline Picture PictureAt(std::int64_t time_us, cv::Size size = {64, 48}) {
  Picture picture;
  picture.time = {time_us};
  picture.period_s = 0.1;
  picture.bgr = cv::Mat(size, CV_8UC3, cv::Scalar(40, 90, 160));
  return picture;
}

}  // namespace deixis::capture
