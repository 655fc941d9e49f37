#include "services/object_detector/core/detectors/place_detector.h"

#include <algorithm>
#include <set>
#include <utility>

namespace deixis::object_detector {
namespace {

using scene::Object;

bool HasValues(const std::vector<double>& values, std::size_t count) {
  return values.empty() || values.size() == count;
}

void CheckPlace(const Place& place, const std::string& key, config::Faults& faults) {
  faults.Require(place.id >= 0, key + ".id", "must not be negative");
  faults.Require(!place.label.empty(), key + ".label", "is empty; say what it is");
  faults.Require(HasValues(place.box_px, 4), key + ".box_px", "must be [left, top, width, height]");
  const bool has_area =
      place.box_px.size() != 4 || (place.box_px[2] > 0.0 && place.box_px[3] > 0.0);
  faults.Require(has_area, key + ".box_px", "must have a positive width and height");
  faults.Require(HasValues(place.position_m, 3), key + ".position_m", "must be [x, y, z]");
  faults.Require(HasValues(place.extent_m, 3), key + ".extent_m", "must be [x, y, z]");
  faults.Require(place.position_sigma_m > 0.0, key + ".position_sigma_m", "must be positive");
  faults.Require(!place.box_px.empty() || !place.position_m.empty(), key,
                 "has neither box_px nor position_m; give one of them");
}

scene::Box ScaledBox(const std::vector<double>& box_px, double scale_x, double scale_y) {
  return {box_px[0] * scale_x, box_px[1] * scale_y, box_px[2] * scale_x, box_px[3] * scale_y};
}

Eigen::Vector3d ToVector(const std::vector<double>& values) {
  if (values.empty()) return Eigen::Vector3d::Zero();
  return {values[0], values[1], values[2]};
}

scene::ObjectPosition PositionOf(const Place& place) {
  const double variance_m2 = place.position_sigma_m * place.position_sigma_m;
  return {ToVector(place.position_m), variance_m2 * Eigen::Matrix3d::Identity(),
          ToVector(place.extent_m)};
}

}  // namespace

void PlacesFile::Validate() const {
  config::Faults faults;
  const bool has_boxes = std::any_of(places.begin(), places.end(),
                                     [](const Place& place) { return !place.box_px.empty(); });
  faults.Require(!has_boxes || image_width_px > 0, "image_width_px", "must be positive");
  faults.Require(!has_boxes || image_height_px > 0, "image_height_px", "must be positive");
  std::set<int> ids;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::string key = "places[" + std::to_string(i) + "]";
    CheckPlace(places[i], key, faults);
    faults.Require(ids.insert(places[i].id).second, key + ".id",
                   "is used twice: " + std::to_string(places[i].id));
  }
  faults.ThrowIfAny();
}

PlacesFile LoadPlaces(const std::string& name, int first_track_id) {
  const std::filesystem::path path = config::FindConfig(name);
  PlacesFile file = config::Load<PlacesFile>(path);
  for (const Place& place : file.places) {
    if (place.id < first_track_id) continue;
    throw config::ConfigError(path.string() + ": place '" + place.label + "' has id " +
                              std::to_string(place.id) + "; ids from " +
                              std::to_string(first_track_id) + " on are for tracked objects");
  }
  std::sort(file.places.begin(), file.places.end(),
            [](const Place& a, const Place& b) { return a.id < b.id; });
  return file;
}

PlaceDetector::PlaceDetector(PlacesFile file) : file_(std::move(file)) {}

std::vector<Object> PlaceDetector::Detect(const GreyPicture& picture) {
  const double scale_x = static_cast<double>(picture.grey.cols) / std::max(1, file_.image_width_px);
  const double scale_y =
      static_cast<double>(picture.grey.rows) / std::max(1, file_.image_height_px);
  std::vector<Object> objects;
  for (const Place& place : file_.places) {
    Object object;
    object.id = place.id;
    object.label = place.label;
    object.kind = place.kind;
    object.score = 1.0;
    object.visibility = scene::Visibility::kRemembered;  // Nobody looks whether it is there.
    if (!place.box_px.empty()) object.box = ScaledBox(place.box_px, scale_x, scale_y);
    if (!place.position_m.empty()) object.position = PositionOf(place);
    objects.push_back(object);
  }
  return objects;
}

}  // namespace deixis::object_detector
