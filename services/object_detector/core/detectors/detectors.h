#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "services/object_detector/core/detectors/cascade_detector.h"
#include "services/object_detector/core/detectors/detector.h"
#include "services/object_detector/core/detectors/place_detector.h"

namespace deixis::object_detector {

/// Every kind of detector with its settings.
struct DetectorsConfig {
  CascadesConfig cascades;  ///< Faces and whatever else a cascade was trained for.
  PlacesConfig places;      ///< Fixed places from a file.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("cascades", cascades);
    v("places", places);
  }
  void Check(config::Faults& faults) const;
};

/// Places keep the ids of their file, which lie below this; tracked objects count from here.
inline constexpr int kFirstTrackId = 1000;

struct Detectors {
  std::vector<std::unique_ptr<Detector>> all;
  std::string frame;   ///< Of the places' positions; empty when there are none.
  std::string remark;  ///< What has to be known about the places; empty = nothing.
};

/// Makes the detectors that `config` asks for: the one place that knows all kinds. `new_id` numbers
/// tracked objects. Throws ConfigError when a cascade or a places file cannot be read.
Detectors MakeDetectors(const DetectorsConfig& config, const std::function<int()>& new_id);

}  // namespace deixis::object_detector
