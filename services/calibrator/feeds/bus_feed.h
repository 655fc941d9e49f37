#pragma once
#include <deque>
#include <memory>

#include "common/transport/bus.h"
#include "services/calibrator/feeds/feed.h"

namespace deixis::calibrator {

/// The newest picture, or pair of pictures, of a channel of the bus; every one where the bus
/// delivers every message, as from a log.
class BusFeed final : public Feed {
 public:
  /// `cameras`: 1 = any picture, 2 = pairs (bot_core.images_t with LEFT and RIGHT). Throws
  /// BusError.
  BusFeed(std::unique_ptr<transport::Bus> bus, const std::string& channel, std::size_t cameras);

  Take Next() override;
  FeedKind kind() const override;
  std::string trouble() const override;

 private:
  void Keep(Timestamp time, std::vector<cv::Mat> bgr);

  std::unique_ptr<transport::Bus> bus_;
  std::string channel_;
  std::deque<Sight> waiting_;  ///< More than one only where every message is delivered.
  int pictures_ = 0;
};

}  // namespace deixis::calibrator
