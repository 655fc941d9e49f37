#pragma once
#include "services/viewer/core/canvas.h"
#include "services/viewer/core/scene_history.h"

namespace deixis::viewer {

/// The limbs of everybody in the scene, far people first: each as the outline of its degenerate
/// cylinder, in the person's colour, or as a thin rod where its model is not known. What is
/// measured is filled; what is inferred or hidden has a broken line; what is lost is a grey rod.
/// Wrists show where 9 of 10 of their possible places are seen.
void DrawBodies(const Scene& scene, Canvas& canvas);

}  // namespace deixis::viewer
