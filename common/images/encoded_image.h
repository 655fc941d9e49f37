#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "common/time/timestamp.h"

namespace deixis::images {

/// One picture of a camera as a JPEG file: how pictures travel.
struct EncodedImage {
  Timestamp time;      ///< Capture time.
  std::string camera;  ///< Which camera.
  int width_px = 0;    ///< Size of the picture when decoded.
  int height_px = 0;
  std::vector<std::uint8_t> jpeg;  ///< One JPEG file.
};

}  // namespace deixis::images
