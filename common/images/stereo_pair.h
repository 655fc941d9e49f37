#pragma once
#include "common/images/encoded_image.h"
#include "common/images/image.h"

namespace deixis::images {

/// Two pictures taken together, as the cameras gave them (not rectified).
struct StereoPair {
  Image left;   ///< Carries the time of both.
  Image right;  ///< Of the same size as `left`.
};

/// A StereoPair as it travels.
struct EncodedStereoPair {
  EncodedImage left;
  EncodedImage right;
};

}  // namespace deixis::images
