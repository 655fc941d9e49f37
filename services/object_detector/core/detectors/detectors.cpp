#include "services/object_detector/core/detectors/detectors.h"

#include <utility>

namespace deixis::object_detector {

void DetectorsConfig::Check(config::Faults& faults) const {
  const auto& [every_cascades, every_places] = *this;
  every_cascades.Check(faults);
  every_places.Check(faults);
}

std::vector<std::unique_ptr<Detector>> MakeDetectors(const DetectorsConfig& config,
                                                     const std::function<int()>& new_id) {
  // The structured binding fails to compile when a kind is added and not made here.
  const auto& [cascades, places] = config;
  std::vector<std::unique_ptr<Detector>> detectors;
  if (!places.file.empty()) {
    detectors.push_back(std::make_unique<PlaceDetector>(LoadPlaces(places.file, kFirstTrackId)));
  }
  for (const CascadeConfig& cascade : cascades.trained) {
    detectors.push_back(std::make_unique<CascadeDetector>(cascade, cascades, new_id));
  }
  return detectors;
}

std::string FrameOfPositions(const DetectorsConfig& config) {
  if (config.places.file.empty()) return "";
  return LoadPlaces(config.places.file, kFirstTrackId).frame;
}

}  // namespace deixis::object_detector
