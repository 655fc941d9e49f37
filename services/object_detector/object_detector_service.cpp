#include "services/object_detector/object_detector_service.h"

#include "common/logging/log.h"
#include "common/messages/image.h"
#include "common/messages/objects.h"
#include "common/transport/channel_name.h"

namespace deixis::object_detector {

void ObjectDetectorServiceConfig::Validate() const {
  config::Faults faults;
  const auto channel_faults = transport::ChannelFaults(
      {{"image_channel", image_channel}, {"objects_channel", objects_channel}});
  for (const auto& [key, fault] : channel_faults) faults.Require(false, key, fault);
  detectors.Check(faults);
  faults.ThrowIfAny();
}

ObjectDetectorService::ObjectDetectorService(const ObjectDetectorServiceConfig& config,
                                             transport::Bus& input, transport::Bus& output)
    : detector_(config.detectors) {
  if (!detector_.remark().empty()) {
    logging::Warn("places",
                  {{"file", config.detectors.places.file}, {"remark", detector_.remark()}});
  }
  input.Subscribe<images::Image>(
      config.image_channel, transport::Delivery::kLatest,
      [this, &output, channel = config.objects_channel](const images::Image& image) {
        output.Publish(channel, detector_.Detect(image));
      });
}

}  // namespace deixis::object_detector
