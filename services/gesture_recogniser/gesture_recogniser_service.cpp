#include "services/gesture_recogniser/gesture_recogniser_service.h"

#include "common/logging/log.h"
#include "common/messages/camera_calibration.h"
#include "common/messages/gesture.h"
#include "common/messages/gesture_state.h"
#include "common/messages/hands.h"
#include "common/messages/objects.h"
#include "common/transport/channel_name.h"

namespace deixis::gesture_recogniser {

void GestureRecogniserServiceConfig::Validate() const {
  config::Faults faults;
  const auto channel_faults =
      transport::ChannelFaults({{"hands_channel", hands_channel},
                                {"objects_channel", objects_channel},
                                {"calibration_channel", calibration_channel},
                                {"state_channel", state_channel},
                                {"gestures_channel", gestures_channel}});
  for (const auto& [key, fault] : channel_faults) faults.Require(false, key, fault);
  faults.Require(!models.empty(), "models", "must name at least one gesture model");
  faults.ThrowIfAny();
}

GestureRecogniserService::GestureRecogniserService(const GestureRecogniserServiceConfig& config,
                                                   transport::Bus& input, transport::Bus& output)
    : config_(config), output_(output), recogniser_(config.recogniser, LoadModels(config.models)) {
  using transport::Delivery;
  input.Subscribe<scene::Hands>(config.hands_channel, Delivery::kEvery,
                                [this](const scene::Hands& hands) { OnHands(hands); });
  input.Subscribe<scene::Objects>(
      config.objects_channel, Delivery::kEvery,
      [this](const scene::Objects& objects) { recogniser_.ObserveObjects(objects); });
  input.Subscribe<geometry::CameraCalibration>(
      config.calibration_channel, Delivery::kEvery,
      [this](const geometry::CameraCalibration& calibration) {
        recogniser_.SetFocalLength(calibration.focal_px.x());
      });
}

transport::Health GestureRecogniserService::health() const {
  if (recogniser_.knows_objects()) return {};
  if (!has_heard_hands_) return {false, "waiting for the first " + config_.objects_channel};
  return {true,
          "no objects are known yet: start object_detector or publish " + config_.objects_channel};
}

void GestureRecogniserService::OnHands(const scene::Hands& hands) {
  has_heard_hands_ = true;
  const Recognition recognition = recogniser_.ObserveHands(hands);
  output_.Publish(config_.state_channel, recognition.state);
  for (const scene::Gesture& gesture : recognition.gestures) {
    Announce(gesture);
    output_.Publish(config_.gestures_channel, gesture);
  }
}

void GestureRecogniserService::Announce(const scene::Gesture& gesture) const {
  if (gesture.end.microseconds != 0) return;
  logging::Info("gesture", {{"id", gesture.event_id},
                            {"hand", gesture.hand_id},
                            {"object", gesture.object_id},
                            {"label", gesture.object_label},
                            {"utime", gesture.time.microseconds}});
}

}  // namespace deixis::gesture_recogniser
