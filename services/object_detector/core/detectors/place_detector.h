#pragma once
#include <string>
#include <vector>

#include "common/config/config.h"
#include "services/object_detector/core/detectors/detector.h"
#include "services/object_detector/core/object_kind_names.h"

namespace deixis::object_detector {

struct PlacesConfig {
  std::string file;  ///< YAML of fixed places, a path or a name under config/. Empty = none.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("file", file);
  }
  void Check(config::Faults&) const {}
};

/// A thing that does not move as seen by a camera that does not move.
struct Place {
  int id = 0;         ///< Below 1000, each once.
  std::string label;  ///< "lamp".
  scene::ObjectKind kind = scene::ObjectKind::kPlace;
  std::vector<double> box_px;      ///< Left, top, width, height; empty = not in the image.
  std::vector<double> position_m;  ///< Centre in the file's frame; empty = not known.
  std::vector<double> extent_m;    ///< Full size along the frame's axes; empty = not known.
  double position_sigma_m = 0.05;  ///< Standard deviation of each coordinate of the position.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("id", id);
    v("label", label);
    v("kind", kind);
    v("box_px", box_px);
    v("position_m", position_m);
    v("extent_m", extent_m);
    v("position_sigma_m", position_sigma_m);
  }
};

/// A file of places, for example config/objects/example.yaml.
struct PlacesFile {
  int image_width_px = 0;  ///< Size of the image that boxes refer to.
  int image_height_px = 0;
  std::string frame;  ///< Frame of the positions; empty = the camera's.
  std::vector<Place> places;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("image_width_px", image_width_px);
    v("image_height_px", image_height_px);
    v("frame", frame);
    v("places", places);
  }
  void Validate() const;
};

/// What has to be known about a places file that is right: it has no places, or two of one label;
/// empty = nothing.
std::string RemarkOn(const PlacesFile& file);

/// Reads a places file. Throws ConfigError, also when an id is not below `first_track_id`.
PlacesFile LoadPlaces(const std::string& name, int first_track_id);

/// Tells the places of a file at every picture, boxes scaled to its size.
class PlaceDetector final : public Detector {
 public:
  explicit PlaceDetector(PlacesFile file);

  std::vector<scene::Object> Detect(const GreyPicture& picture) override;
  void Reset() override {}

 private:
  PlacesFile file_;
};

}  // namespace deixis::object_detector
