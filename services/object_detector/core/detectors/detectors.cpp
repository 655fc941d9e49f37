#include "services/object_detector/core/detectors/detectors.h"

#include <utility>

namespace deixis::object_detector {

void DetectorsConfig::Check(config::Faults& faults) const {
  const auto& [every_cascades, every_places] = *this;
  every_cascades.Check(faults);
  every_places.Check(faults);
}

Detectors MakeDetectors(const DetectorsConfig& config, const std::function<int()>& new_id) {
  // The structured binding fails to compile when a kind is added and not made here.
  const auto& [cascades, places] = config;
  Detectors detectors;
  if (!places.file.empty()) {
    PlacesFile file = LoadPlaces(places.file, kFirstTrackId);
    detectors.frame = file.frame;
    detectors.remark = RemarkOn(file);
    detectors.all.push_back(std::make_unique<PlaceDetector>(std::move(file)));
  }
  for (const CascadeConfig& cascade : cascades.trained) {
    detectors.all.push_back(std::make_unique<CascadeDetector>(cascade, cascades, new_id));
  }
  return detectors;
}

}  // namespace deixis::object_detector
