#pragma once
#include <string>

#include "common/transport/bus.h"
#include "services/object_detector/core/object_detector.h"

namespace deixis::object_detector {

struct ObjectDetectorServiceConfig {
  std::string image_channel = "CAMERA";     ///< Pictures: CAMERA, or STEREO for its left image.
  std::string objects_channel = "OBJECTS";  ///< What was found goes here.
  DetectorsConfig detectors;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("image_channel", image_channel);
    v("objects_channel", objects_channel);
    detectors.Visit(v);  // On the same level: `cascades`, `places`.
  }
  void Validate() const;
};

/// Answers every picture with the objects that are known.
class ObjectDetectorService {
 public:
  ObjectDetectorService(const ObjectDetectorServiceConfig& config, transport::Bus& input,
                        transport::Bus& output);

 private:
  ObjectDetector detector_;
};

}  // namespace deixis::object_detector
