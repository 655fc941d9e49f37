#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "common/scene/object.h"
#include "common/time/timestamp.h"

namespace deixis::object_detector {

/// A picture as detectors see it.
struct GreyPicture {
  Timestamp time;
  cv::Mat grey;  ///< rows x cols, CV_8UC1.
};

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
