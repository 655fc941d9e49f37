#include "services/stereo_driver/core/sources/side_by_side_source.h"

#include <utility>

namespace deixis::stereo_driver {

using capture::SourceState;

SideBySideSource::SideBySideSource(std::unique_ptr<capture::Source> source, LeftHalf left_half)
    : source_(std::move(source)), left_half_(left_half) {}

FrameGrab SideBySideSource::Next() {
  const capture::Grab grab = source_->Next();
  if (!grab.picture) return {grab.state, std::nullopt};
  if (auto frame = Split(*grab.picture)) return {SourceState::kPicture, std::move(frame)};
  ++unusable_;
  return {SourceState::kWaiting, std::nullopt};
}

FrameSourceStatus SideBySideSource::status() const {
  return {source_->status(), 0, 0, unusable_, {}};
}

std::optional<Frame> SideBySideSource::Split(const capture::Picture& picture) const {
  const int width = picture.bgr.cols / 2;
  if (width == 0 || picture.bgr.cols % 2 != 0) return std::nullopt;
  cv::Mat left = picture.bgr.colRange(0, width);
  cv::Mat right = picture.bgr.colRange(width, 2 * width);
  if (left_half_ == LeftHalf::kRight) std::swap(left, right);
  return Frame{picture.time,
               images::StereoPair{{picture.time, "", left}, {picture.time, "", right}},
               picture.period_s};
}

}  // namespace deixis::stereo_driver
