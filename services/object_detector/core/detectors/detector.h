#pragma once
#include <vector>

#include "common/scene/object.h"
#include "services/object_detector/core/grey_picture.h"

namespace deixis::object_detector {

/// Knows objects of one kind in a sequence of pictures.
class Detector {
 public:
  virtual ~Detector() = default;

  /// What is known after `picture`, the next one in time, by ascending id. Boxes in its pixels.
  virtual std::vector<scene::Object> Detect(const GreyPicture& picture) = 0;

  /// Forgets the pictures so far: another recording begins.
  virtual void Reset() = 0;
};

}  // namespace deixis::object_detector
