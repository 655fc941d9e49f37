#include "services/object_detector/object_detector_service.h"

#include "common/messages/image.h"
#include "common/messages/objects.h"

namespace deixis::object_detector {

void ObjectDetectorServiceConfig::Validate() const {
  config::Faults faults;
  faults.Require(!image_channel.empty(), "image_channel", "is empty; name a channel");
  faults.Require(!objects_channel.empty(), "objects_channel", "is empty; name a channel");
  detectors.Check(faults);
  faults.ThrowIfAny();
}

ObjectDetectorService::ObjectDetectorService(const ObjectDetectorServiceConfig& config,
                                             transport::Bus& input, transport::Bus& output)
    : detector_(config.detectors) {
  input.Subscribe<images::Image>(
      config.image_channel, transport::Delivery::kLatest,
      [this, &output, channel = config.objects_channel](const images::Image& image) {
        output.Publish(channel, detector_.Detect(image));
      });
}

}  // namespace deixis::object_detector
