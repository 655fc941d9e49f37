#include "services/stereo_driver/core/sources/matched_source.h"

#include <limits>
#include <opencv2/core.hpp>
#include <utility>

namespace deixis::stereo_driver {
namespace {

using capture::Picture;
using capture::Source;
using capture::SourceState;
using capture::SourceStatus;

// Pictures of either side that may wait for one of the other: a decoded one may take 200 MB. So
// many periods may one camera be later than the other.
constexpr std::size_t kMostWaiting = 5;

// What waits in a live camera is the newest picture, which would be lost; in a recording, the next
// one.
bool KeepsWhatIsNotFetched(const Source& source) { return !source.status().is_live; }

SourceStatus Together(const SourceStatus& left, const SourceStatus& right) {
  SourceStatus status = left;
  status.is_live = left.is_live && right.is_live;
  if (!right.trouble.empty())
    status.trouble += (status.trouble.empty() ? "" : "; ") + right.trouble;
  status.skipped += right.skipped;
  status.corrupt += right.corrupt;
  if (status.last_corrupt.empty()) status.last_corrupt = right.last_corrupt;
  return status;
}

// What lies farther than 16 bits can say counts as not measured.
cv::Mat InMillimetres(const cv::Mat& depth, double unit_mm) {
  if (unit_mm == 1.0) return depth;
  cv::Mat depth_mm;
  depth.convertTo(depth_mm, CV_16UC1, unit_mm);
  depth_mm.setTo(0, depth > std::numeric_limits<std::uint16_t>::max() / unit_mm);
  return depth_mm;
}

}  // namespace

MatchedSource::MatchedSource(std::unique_ptr<Source> left, std::unique_ptr<Source> right,
                             double max_skew_s, Compose compose)
    : left_(std::move(left)),
      right_(std::move(right)),
      compose_(std::move(compose)),
      matcher_(max_skew_s, kMostWaiting) {}

FrameGrab MatchedSource::Next() {
  if (auto frame = NextMatch()) return {SourceState::kPicture, std::move(frame)};
  FetchLeft();
  FetchRight();
  if (auto frame = NextMatch()) return {SourceState::kPicture, std::move(frame)};
  if (!HasEnded()) return {SourceState::kWaiting, std::nullopt};
  matcher_.Finish();
  return {SourceState::kFinished, std::nullopt};
}

std::optional<Frame> MatchedSource::NextMatch() {
  while (const auto match = matcher_.Next()) {
    if (auto frame = compose_(match->first, match->second)) return frame;
    ++unusable_;
  }
  return std::nullopt;
}

void MatchedSource::FetchLeft() {
  if (left_state_ == SourceState::kFinished) return;
  if (!matcher_.wants_first() && KeepsWhatIsNotFetched(*left_)) return;
  capture::Grab grab = left_->Next();
  left_state_ = grab.state;
  if (grab.picture) matcher_.AddFirst(grab.picture->time, std::move(*grab.picture));
}

void MatchedSource::FetchRight() {
  if (right_state_ == SourceState::kFinished) return;
  if (!matcher_.wants_second() && KeepsWhatIsNotFetched(*right_)) return;
  capture::Grab grab = right_->Next();
  right_state_ = grab.state;
  if (grab.picture) matcher_.AddSecond(grab.picture->time, std::move(*grab.picture));
}

bool MatchedSource::HasEnded() const {
  return matcher_.IsOver(left_state_ == SourceState::kFinished,
                         right_state_ == SourceState::kFinished);
}

FrameSourceStatus MatchedSource::status() const {
  return {Together(left_->status(), right_->status()),
          matcher_.unmatched_first(),
          matcher_.unmatched_second(),
          unusable_,
          {}};
}

std::optional<Frame> ComposePair(const Picture& left, const Picture& right) {
  if (left.bgr.size() != right.bgr.size()) return std::nullopt;
  return Frame{left.time, images::StereoPair{{left.time, "", left.bgr}, {left.time, "", right.bgr}},
               left.period_s};
}

std::optional<Frame> ComposeColourAndDepth(const Picture& colour, const Picture& depth,
                                           double depth_unit_mm) {
  const cv::Mat depth_mm = InMillimetres(depth.depth, depth_unit_mm);
  return Frame{colour.time,
               images::RgbdImage{{colour.time, "", colour.bgr},
                                 {colour.time, "", depth_mm},
                                 /*is_registered=*/true},
               colour.period_s};
}

}  // namespace deixis::stereo_driver
