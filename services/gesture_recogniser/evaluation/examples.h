#pragma once
#include <vector>

#include "services/gesture_recogniser/core/gesture_model.h"
#include "services/gesture_recogniser/core/image_scale.h"
#include "services/gesture_recogniser/core/training.h"
#include "services/gesture_recogniser/evaluation/recording.h"
#include "services/gesture_recogniser/evaluation/tracked_hands.h"

namespace deixis::gesture_recogniser {

/// Learns `approach` and `rest` from the labelled gestures of `recordings`, those of
/// `without_person` left out (empty = none). The hands are seen with `noise`. Throws
/// std::invalid_argument when nothing remains.
std::vector<GestureModel> TrainModels(const std::vector<Recording>& recordings,
                                      const std::string& without_person, const TrackNoise& noise,
                                      const MotionConfig& motion, const ImageScaleConfig& scale);

}  // namespace deixis::gesture_recogniser
