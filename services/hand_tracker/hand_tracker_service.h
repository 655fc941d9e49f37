#pragma once
#include <string>

#include "common/transport/bus.h"
#include "services/hand_tracker/core/hand_tracker.h"

namespace deixis::hand_tracker {

struct HandTrackerServiceConfig {
  std::string image_channel = "CAMERA";       ///< Pictures: CAMERA, or STEREO for its left image.
  std::string objects_channel = "OBJECTS";    ///< Faces come from here.
  std::string hands_channel = "HAND_TRACKS";  ///< Hands go here, one message per picture.
  HandTrackerConfig tracker;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("image_channel", image_channel);
    v("objects_channel", objects_channel);
    v("hands_channel", hands_channel);
    v("tracker", tracker);
  }
  void Validate() const;
};

/// Answers every picture with the hands that are followed.
class HandTrackerService {
 public:
  HandTrackerService(const HandTrackerServiceConfig& config, transport::Bus& input,
                     transport::Bus& output);

 private:
  HandTracker tracker_;
};

}  // namespace deixis::hand_tracker
