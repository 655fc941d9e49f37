#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

#include "services/viewer/core/scene_history.h"

namespace deixis::viewer {

/// The scene's picture with all that is known drawn on it: objects with label and probability,
/// hands with id, side and velocity, the acting hand, where objects are looked for, people's limbs,
/// and the decision. Lines and letters grow with the picture.
cv::Mat DrawOverlay(const Scene& scene);

/// The decision in words: "pointing at: lamp 0.93".
std::string DecisionText(const scene::Gesture& gesture);

}  // namespace deixis::viewer
