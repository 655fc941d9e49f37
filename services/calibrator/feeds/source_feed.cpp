#include "services/calibrator/feeds/source_feed.h"

#include <chrono>
#include <cmath>
#include <opencv2/core/utils/logger.hpp>
#include <thread>

namespace deixis::calibrator {
namespace {

/// Pictures of two live cameras that lie farther apart do not show one moment; a board that is held
/// still is asked for besides.
constexpr double kMostApart_s = 0.040;
constexpr std::chrono::milliseconds kWait{2};

template <typename Clock>
Timestamp Now() {
  const auto since_start = Clock::now().time_since_epoch();
  return {std::chrono::duration_cast<std::chrono::microseconds>(since_start).count()};
}

std::vector<cv::Mat> Split(const cv::Mat& bgr, PictureLayout layout) {
  if (layout == PictureLayout::kOneCamera) return {bgr};
  const int half = bgr.cols / 2;
  return {bgr.colRange(0, half).clone(), bgr.colRange(half, 2 * half).clone()};
}

std::string TroubleOf(const capture::SourceStatus& status) {
  if (!status.trouble.empty()) return status.trouble;
  if (status.corrupt == 0) return "";
  return std::to_string(status.corrupt) + " pictures could not be read" +
         (status.last_corrupt.empty() ? "" : ", the last one " + status.last_corrupt);
}

FeedKind KindOf(const capture::Source& source) {
  return source.status().is_live ? FeedKind::kLive : FeedKind::kRecording;
}

void WaitIfLive(const capture::Source& source) {
  if (source.status().is_live) std::this_thread::sleep_for(kWait);
}

}  // namespace

SourceFeed::SourceFeed(std::unique_ptr<capture::Source> source, PictureLayout layout)
    : source_(std::move(source)), layout_(layout) {}

Take SourceFeed::Next() {
  capture::Grab grab = source_->Next();
  if (grab.state == capture::SourceState::kWaiting) WaitIfLive(*source_);
  if (!grab.picture) return {grab.state, std::nullopt};
  return {grab.state, Sight{"picture " + std::to_string(++pictures_), grab.picture->time,
                            Split(grab.picture->bgr, layout_)}};
}

FeedKind SourceFeed::kind() const { return KindOf(*source_); }

std::string SourceFeed::trouble() const { return TroubleOf(source_->status()); }

TwoSourceFeed::TwoSourceFeed(std::unique_ptr<capture::Source> left,
                             std::unique_ptr<capture::Source> right) {
  sources_.push_back(std::move(left));
  sources_.push_back(std::move(right));
  if (KindOf(*sources_[0]) != KindOf(*sources_[1])) {
    throw config::ConfigError("--source and --right-source must both be live or both recordings");
  }
}

bool TwoSourceFeed::Fetch(std::size_t side) {
  if (waiting_[side]) return true;
  capture::Grab grab = sources_[side]->Next();
  waiting_[side] = std::move(grab.picture);
  return grab.state != capture::SourceState::kFinished;
}

// Live: of two pictures that do not show one moment, the older one is given up.
bool TwoSourceFeed::BelongTogether() {
  if (kind() == FeedKind::kRecording) return true;
  const double apart_s = SecondsBetween(waiting_[0]->time, waiting_[1]->time);
  if (std::abs(apart_s) <= kMostApart_s) return true;
  waiting_[apart_s > 0.0 ? 0 : 1].reset();
  ++unpaired_;
  return false;
}

Take TwoSourceFeed::Next() {
  if (!Fetch(0) || !Fetch(1)) return {capture::SourceState::kFinished, std::nullopt};
  if (!waiting_[0] || !waiting_[1] || !BelongTogether()) {
    WaitIfLive(*sources_[0]);
    return {capture::SourceState::kWaiting, std::nullopt};
  }
  Sight sight{
      "pair " + std::to_string(++pairs_), waiting_[0]->time, {waiting_[0]->bgr, waiting_[1]->bgr}};
  waiting_[0].reset();
  waiting_[1].reset();
  return {capture::SourceState::kPicture, std::move(sight)};
}

FeedKind TwoSourceFeed::kind() const { return KindOf(*sources_[0]); }

std::string TwoSourceFeed::trouble() const {
  for (const auto& source : sources_) {
    const std::string trouble = TroubleOf(source->status());
    if (!trouble.empty()) return trouble;
  }
  if (unpaired_ == 0) return "";
  return std::to_string(unpaired_) + " pictures had none of the other camera within 40 ms";
}

capture::SourceConfig ParseSource(const std::string& text, const std::string& option) {
  capture::SourceConfig config;
  config.key = option;
  config.width_px = 0;
  config.height_px = 0;
  const auto colon = text.find(':');
  for (const auto& [name, kind] : EnumNames(capture::SourceKind{})) {
    if (colon == std::string::npos || text.substr(0, colon) != name) continue;
    config.kind = kind;
    config.path = text.substr(colon + 1);
    return config;
  }
  throw config::ConfigError(option + " '" + text +
                            "' must begin with device:, url:, video: or folder:");
}

std::unique_ptr<capture::Source> OpenSource(const capture::SourceConfig& config) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  config::Faults faults;
  config.Check(faults);
  faults.ThrowIfAny();
  return capture::MakeSource(config,
                             {Now<std::chrono::system_clock>, Now<std::chrono::steady_clock>});
}

}  // namespace deixis::calibrator
