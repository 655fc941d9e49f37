#include "services/object_detector/core/detectors/place_detector.h"

#include <algorithm>
#include <set>
#include <utility>

#include "common/config/plain_text.h"

namespace deixis::object_detector {
namespace {

using scene::Object;

constexpr double kFarthest_m = 1e4;

bool HasValues(const std::vector<double>& values, std::size_t count) {
  return values.empty() || values.size() == count;
}

bool LieIn(double lowest, double highest, const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [lowest, highest](double value) {
    return value >= lowest && value <= highest;
  });
}

/// Whether `box_px` shows in a picture of this size and is no larger than it.
bool IsInPicture(const std::vector<double>& box_px, int width_px, int height_px) {
  const auto overlaps = [](double start, double size, double picture) {
    return size <= picture && start < picture && start + size > 0.0;
  };
  return overlaps(box_px[0], box_px[2], width_px) && overlaps(box_px[1], box_px[3], height_px);
}

void CheckBox(const Place& place, const std::string& key, const PlacesFile& file,
              config::Faults& faults) {
  faults.Require(HasValues(place.box_px, 4), key, "must be [left, top, width, height]");
  if (place.box_px.size() != 4) return;
  const bool has_area = place.box_px[2] >= 1.0 && place.box_px[3] >= 1.0;
  faults.Require(has_area, key, "must have a width and height of at least one pixel");
  const bool is_seen = !has_area || file.image_width_px <= 0 || file.image_height_px <= 0 ||
                       IsInPicture(place.box_px, file.image_width_px, file.image_height_px);
  faults.Require(is_seen, key, "must lie in the picture of image_width_px x image_height_px");
}

void CheckPlace(const Place& place, const std::string& key, const PlacesFile& file,
                config::Faults& faults) {
  faults.Require(place.id >= 0, key + ".id", "must not be negative");
  faults.Require(config::IsPlainText(place.label), key + ".label", config::kPlainTextRule);
  CheckBox(place, key + ".box_px", file, faults);
  faults.Require(HasValues(place.position_m, 3), key + ".position_m", "must be [x, y, z]");
  faults.Require(LieIn(-kFarthest_m, kFarthest_m, place.position_m), key + ".position_m",
                 "must lie within 10000 m");
  faults.Require(HasValues(place.extent_m, 3), key + ".extent_m", "must be [x, y, z]");
  faults.Require(LieIn(0.0, kFarthest_m, place.extent_m), key + ".extent_m",
                 "must lie in 0..10000 m");
  faults.Require(place.position_sigma_m > 0.0 && place.position_sigma_m <= kFarthest_m,
                 key + ".position_sigma_m", "must be positive, 10000 m at most");
  faults.Require(!place.box_px.empty() || !place.position_m.empty(), key,
                 "has neither box_px nor position_m; give one of them");
}

scene::Box ScaledBox(const std::vector<double>& box_px, double scale_x, double scale_y) {
  // A pixel at least, as receivers want it of a face.
  return {box_px[0] * scale_x, box_px[1] * scale_y, std::max(1.0, box_px[2] * scale_x),
          std::max(1.0, box_px[3] * scale_y)};
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
  faults.Require(frame.empty() || config::IsPlainText(frame), "frame", config::kPlainTextRule);
  std::set<int> ids;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::string key = "places[" + std::to_string(i) + "]";
    CheckPlace(places[i], key, *this, faults);
    faults.Require(ids.insert(places[i].id).second, key + ".id",
                   "is used twice: " + std::to_string(places[i].id));
  }
  faults.ThrowIfAny();
}

std::string RemarkOn(const PlacesFile& file) {
  if (file.places.empty()) return "no places are known: the places file has none";
  std::set<std::string> labels;
  for (const Place& place : file.places) {
    if (!labels.insert(place.label).second) {
      return "several places are labelled '" + place.label + "': only their ids tell them apart";
    }
  }
  return "";
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
