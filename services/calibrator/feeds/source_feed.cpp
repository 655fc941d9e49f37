#include "services/calibrator/feeds/source_feed.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <thread>

#include "common/capture/system_clocks.h"
#include "services/calibrator/core/figures.h"

namespace deixis::calibrator {
namespace {

/// Pictures that lie farther apart do not show one moment; a board that is held still is asked for
/// besides.
constexpr double kMostApart_s = 0.040;
/// Of the time to the next picture: from half of it on, a recorded picture whose partner cannot be
/// read would take its partner's neighbour.
constexpr double kMostOfPeriod = 0.45;
constexpr double kRateOfOrder_hz = 1.0;
constexpr std::chrono::milliseconds kWait{2};

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

double MostApart_s(const std::array<capture::Grab, 2>& grabs) {
  double most_s = kMostApart_s;
  for (const capture::Grab& grab : grabs) {
    if (!grab.picture || grab.picture->period_s <= 0.0) continue;
    most_s = std::min(most_s, kMostOfPeriod * grab.picture->period_s);
  }
  return most_s;
}

capture::PairedSources Paired(std::unique_ptr<capture::Source> left,
                              std::unique_ptr<capture::Source> right) {
  if (left->status().is_live != right->status().is_live) {
    throw config::ConfigError("--source and --right-source must both be live or both recordings");
  }
  std::array<capture::Grab, 2> begun{left->Next(), right->Next()};
  const double most_apart_s = MostApart_s(begun);
  return {std::move(left), std::move(right), most_apart_s, std::move(begun)};
}

bool LacksTimes(const capture::SourceConfig& config) {
  std::error_code ignored;  // What cannot be looked at is not there.
  return config.kind == capture::SourceKind::kFolder &&
         !std::filesystem::exists(std::filesystem::path(config.path) / "times.csv", ignored);
}

void WaitIfLive(const capture::Source& source) {
  if (source.status().is_live) std::this_thread::sleep_for(kWait);
}

}  // namespace

SourceFeed::SourceFeed(std::unique_ptr<capture::Source> source, PictureLayout layout, FeedKind kind)
    : source_(std::move(source)), layout_(layout), kind_(kind) {}

Take SourceFeed::Next() {
  capture::Grab grab = source_->Next();
  if (grab.state == capture::SourceState::kWaiting) WaitIfLive(*source_);
  if (!grab.picture) return {grab.state, std::nullopt};
  return {grab.state, Sight{"picture " + std::to_string(++pictures_), grab.picture->time,
                            Split(grab.picture->bgr, layout_)}};
}

FeedKind SourceFeed::kind() const { return kind_; }

std::string SourceFeed::trouble() const { return TroubleOf(source_->status()); }

TwoSourceFeed::TwoSourceFeed(std::unique_ptr<capture::Source> left,
                             std::unique_ptr<capture::Source> right, FeedKind kind)
    : kind_(kind), sources_(Paired(std::move(left), std::move(right))) {}

Take TwoSourceFeed::Next() {
  capture::PairGrab grab = sources_.Next();
  if (grab.state == capture::SourceState::kWaiting) WaitIfLive(sources_.first());
  if (!grab.pair) return {grab.state, std::nullopt};
  return {grab.state, Sight{"pair " + std::to_string(++pairs_),
                            grab.pair->first_time,
                            {grab.pair->first.bgr, grab.pair->second.bgr}}};
}

FeedKind TwoSourceFeed::kind() const { return kind_; }

std::string TwoSourceFeed::trouble() const {
  for (const capture::Source* source : {&sources_.first(), &sources_.second()}) {
    std::string trouble = TroubleOf(source->status());
    if (!trouble.empty()) return trouble;
  }
  const std::int64_t unpaired = sources_.unmatched_first() + sources_.unmatched_second();
  if (unpaired == 0) return "";
  return std::to_string(unpaired) + Figures(" pictures had none of the other camera within %.0f ms",
                                            1e3 * sources_.max_skew_s());
}

void TimeByOrderUnlessAllHaveTimes(std::vector<capture::SourceConfig>& configs) {
  if (std::none_of(configs.begin(), configs.end(), LacksTimes)) return;
  for (capture::SourceConfig& config : configs) {
    if (capture::IsRecording(config) && config.rate_hz == 0.0) config.rate_hz = kRateOfOrder_hz;
  }
}

FeedKind KindOf(const std::vector<capture::SourceConfig>& configs) {
  if (std::any_of(configs.begin(), configs.end(), LacksTimes)) return FeedKind::kSeparate;
  return std::all_of(configs.begin(), configs.end(), capture::IsRecording) ? FeedKind::kRecording
                                                                           : FeedKind::kLive;
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
  config::Faults faults;
  config.Check(faults);
  faults.ThrowIfAny();
  return capture::MakeSource(config, capture::SystemClocks());
}

}  // namespace deixis::calibrator
