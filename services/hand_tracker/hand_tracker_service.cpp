#include "services/hand_tracker/hand_tracker_service.h"

#include "common/messages/hands.h"
#include "common/messages/image.h"
#include "common/messages/objects.h"

namespace deixis::hand_tracker {

void HandTrackerServiceConfig::Validate() const {
  tracker.Validate();
  config::Faults faults;
  faults.Require(!image_channel.empty(), "image_channel", "must be a channel's name");
  faults.Require(!objects_channel.empty(), "objects_channel", "must be a channel's name");
  faults.Require(!hands_channel.empty(), "hands_channel", "must be a channel's name");
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
