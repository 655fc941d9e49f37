#pragma once
#include "common/images/depth_image.h"
#include "common/images/image.h"

namespace deixis::images {

/// Colour and depth of one frame of a depth camera, as it gave them.
struct RgbdImage {
  Image colour;
  DepthImage depth;           ///< May have another size than `colour`.
  bool is_registered = true;  ///< Whether `depth` is seen from the colour camera.
};

}  // namespace deixis::images
