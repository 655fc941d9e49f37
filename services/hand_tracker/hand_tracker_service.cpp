#include "services/hand_tracker/hand_tracker_service.h"

#include "common/messages/hands.h"
#include "common/messages/image.h"
#include "common/messages/objects.h"
#include "common/transport/channel_name.h"

namespace deixis::hand_tracker {

void HandTrackerServiceConfig::Validate() const {
  config::Faults faults;
  const auto channel_faults = transport::ChannelFaults({{"image_channel", image_channel},
                                                        {"objects_channel", objects_channel},
                                                        {"hands_channel", hands_channel}});
  for (const auto& [key, fault] : channel_faults) faults.Require(false, key, fault);
  faults.ThrowIfAny();
}

HandTrackerService::HandTrackerService(const HandTrackerServiceConfig& config,
                                       transport::Bus& input, transport::Bus& output)
    : tracker_(config.tracker) {
  using transport::Delivery;
  input.Subscribe<scene::Objects>(
      config.objects_channel, Delivery::kEvery,
      [this](const scene::Objects& objects) { tracker_.UpdateFaces(objects); });
  input.Subscribe<images::Image>(
      config.image_channel, Delivery::kLatest,
      [this, &output, channel = config.hands_channel](const images::Image& image) {
        output.Publish(channel, tracker_.Track(image));
      });
}

}  // namespace deixis::hand_tracker
