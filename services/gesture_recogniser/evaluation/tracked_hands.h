#pragma once
#include <cstdint>
#include <vector>

#include "common/scene/hand.h"
#include "services/gesture_recogniser/evaluation/recording.h"

namespace deixis::gesture_recogniser {

/// How a tracker would have seen true hands.
struct TrackNoise {
  double sigma_px = 2.5;              ///< Added to each true coordinate; 0 = as recorded.
  double jerk_density = 7.0e7;        ///< Of the Kalman filter, px^2/s^5.
  double acceleration_time_s = 0.25;  ///< In which accelerations die away.
  std::uint64_t seed = 1;
};

/// The hands of every frame as messages. True hands get noise and pass through the
/// constant-acceleration filter; tracked ones are passed on.
std::vector<scene::Hands> TrackedHands(const Recording& recording, const TrackNoise& noise);

/// Objects and face of one frame as a message.
scene::Objects ObjectsAt(const Recording& recording, const RecordedFrame& frame,
                         const std::vector<scene::Object>& objects);

Timestamp TimeOf(double seconds);

}  // namespace deixis::gesture_recogniser
