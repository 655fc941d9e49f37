#include "services/calibrator/feeds/bus_feed.h"

#include <utility>

#include "common/config/config.h"
#include "common/messages/image.h"
#include "common/messages/stereo_pair.h"

namespace deixis::calibrator {
namespace {

constexpr std::chrono::milliseconds kWait{50};

}  // namespace

BusFeed::BusFeed(std::unique_ptr<transport::Bus> bus, const std::string& channel,
                 std::size_t cameras)
    : bus_(std::move(bus)), channel_(channel) {
  if (cameras == 1) {
    bus_->Subscribe<images::Image>(
        channel, transport::Delivery::kLatest,
        [this](const images::Image& image) { Keep(image.time, {image.bgr}); });
    return;
  }
  bus_->Subscribe<images::StereoPair>(channel, transport::Delivery::kLatest,
                                      [this](const images::StereoPair& pair) {
                                        Keep(pair.left.time, {pair.left.bgr, pair.right.bgr});
                                      });
}

void BusFeed::Keep(Timestamp time, std::vector<cv::Mat> bgr) {
  waiting_.push_back({"picture " + std::to_string(++pictures_), time, std::move(bgr)});
}

Take BusFeed::Next() {
  // One call hands over all pictures of a log that are due by now.
  if (waiting_.empty()) bus_->Handle(kWait);
  if (waiting_.empty()) {
    const bool is_over = bus_->is_exhausted();
    return {is_over ? capture::SourceState::kFinished : capture::SourceState::kWaiting,
            std::nullopt};
  }
  Sight sight = std::move(waiting_.front());
  waiting_.pop_front();
  return {capture::SourceState::kPicture, std::move(sight)};
}

FeedKind BusFeed::kind() const { return bus_->is_live() ? FeedKind::kLive : FeedKind::kRecording; }

std::string BusFeed::trouble() const {
  return pictures_ == 0 ? "no pictures have come on channel " + channel_ : "";
}

}  // namespace deixis::calibrator
