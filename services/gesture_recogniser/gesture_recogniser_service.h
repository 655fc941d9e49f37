#pragma once
#include <string>
#include <vector>

#include "common/geometry/camera_calibration.h"
#include "common/transport/bus.h"
#include "common/transport/status_reporter.h"
#include "services/gesture_recogniser/core/pointing_recogniser.h"

namespace deixis::gesture_recogniser {

struct GestureRecogniserServiceConfig {
  std::string hands_channel = "HAND_TRACKS";               ///< In: hand tracks.
  std::string objects_channel = "OBJECTS";                 ///< In: objects and faces.
  std::string calibration_channel = "CAMERA_CALIBRATION";  ///< In: the focal length.
  std::string state_channel = "GESTURE_STATE";             ///< Out: what is thought of each hand.
  std::string gestures_channel = "GESTURES";               ///< Out: decisions and their ends.
  std::vector<std::string> models{"approach", "rest"};     ///< Files config/gestures/<name>.yaml.
  PointingRecogniserConfig recogniser;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("hands_channel", hands_channel);
    v("objects_channel", objects_channel);
    v("calibration_channel", calibration_channel);
    v("state_channel", state_channel);
    v("gestures_channel", gestures_channel);
    v("models", models);
    v("recogniser", recogniser);
  }
  void Validate() const;
};

/// Hand tracks and objects in, gesture state and events out.
class GestureRecogniserService {
 public:
  /// Throws ConfigError when a gesture model cannot be read.
  GestureRecogniserService(const GestureRecogniserServiceConfig& config, transport::Bus& input,
                           transport::Bus& output);

  /// Degraded when hands come and objects do not; before either has come, nothing is wrong yet.
  transport::Health health() const;

 private:
  void OnHands(const scene::Hands& hands);
  void Announce(const scene::Gesture& gesture) const;

  GestureRecogniserServiceConfig config_;
  transport::Bus& output_;
  PointingRecogniser recogniser_;
  bool has_heard_hands_ = false;
};

}  // namespace deixis::gesture_recogniser
