#pragma once
#include <memory>

#include "common/transport/bus.h"
#include "services/calibrator/feeds/feed.h"

namespace deixis::calibrator {

/// The newest picture, or pair of pictures, of a channel of the bus, or all those of a log.
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
  std::optional<Sight> newest_;
  int pictures_ = 0;
};

}  // namespace deixis::calibrator
