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
    : sources_(std::move(left), std::move(right), max_skew_s), compose_(std::move(compose)) {}

FrameGrab MatchedSource::Next() {
  const capture::PairGrab grab = sources_.Next();
  if (!grab.pair) return {grab.state, std::nullopt};
  if (auto frame = compose_(grab.pair->first, grab.pair->second)) {
    return {SourceState::kPicture, std::move(frame)};
  }
  ++unusable_;
  return {SourceState::kWaiting, std::nullopt};
}

FrameSourceStatus MatchedSource::status() const {
  return {Together(sources_.first().status(), sources_.second().status()),
          sources_.unmatched_first(),
          sources_.unmatched_second(),
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
