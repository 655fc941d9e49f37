#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/images/image.h"
#include "common/scene/object.h"
#include "services/object_detector/core/detectors/detectors.h"

namespace deixis::object_detector {

/// Runs all detectors on a sequence of pictures.
class ObjectDetector {
 public:
  /// Throws ConfigError when a file that `config` names cannot be read.
  explicit ObjectDetector(const DetectorsConfig& config);
  ObjectDetector(const ObjectDetector&) = delete;  // Detectors number their objects through it.
  ObjectDetector& operator=(const ObjectDetector&) = delete;

  /// All objects that are known after `image`, by ascending id. A time before the last image's
  /// begins anew; ids are not used again.
  scene::Objects Detect(const images::Image& image);

  /// What has to be known about the configuration that was read; empty = nothing.
  const std::string& remark() const { return detectors_.remark; }

 private:
  void ResetIfTimeWentBack(Timestamp time);

  int next_id_ = kFirstTrackId;
  Detectors detectors_;
  std::optional<Timestamp> last_time_;
};

}  // namespace deixis::object_detector
