#pragma once
#include <cstddef>
#include <map>
#include <optional>

#include "common/config/config.h"
#include "common/scene/hand.h"
#include "common/scene/object.h"

namespace deixis::gesture_recogniser {

/// Where the scale of the image comes from.
enum class ScaleSource {
  kFace,    ///< The height of the person's face; without one as kCamera.
  kCamera,  ///< Focal length and assumed distance; without a calibration as kFixed.
  kFixed    ///< A fixed number.
};
inline auto EnumNames(ScaleSource) {
  return std::vector<std::pair<std::string, ScaleSource>>{{"face", ScaleSource::kFace},
                                                          {"camera", ScaleSource::kCamera},
                                                          {"fixed", ScaleSource::kFixed}};
}

struct ImageScaleConfig {
  ScaleSource source = ScaleSource::kFace;
  double face_height_m = 0.18;      ///< What the height of a face's box measures on the person.
  double assumed_distance_m = 2.0;  ///< Of people without a face, with a calibrated camera.
  double fixed_px_per_m = 277.0;    ///< Without either: 640 pixels, 60 degrees, 2 m.
  double smoothing_s = 2.0;         ///< Time constant with which the face's height is smoothed.
  double face_memory_s = 5.0;       ///< How long a face that is out of sight counts.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("source", source);
    v("face_height_m", face_height_m);
    v("assumed_distance_m", assumed_distance_m);
    v("fixed_px_per_m", fixed_px_per_m);
    v("smoothing_s", smoothing_s);
    v("face_memory_s", face_memory_s);
  }
  void Validate() const;
};

/// A face with its smoothed height.
struct KnownFace {
  scene::Box box;
  double height_px = 0.0;
  int person_id = -1;
  Timestamp last_seen;
};

/// A box as it measures at the person's distance: the result's fields hold metres.
scene::Box InMetres(const scene::Box& box, double px_per_m);

/// Remembers faces, says which one belongs to a hand, and how many pixels a metre has at the
/// person.
class ImageScale {
 public:
  explicit ImageScale(const ImageScaleConfig& config) : config_(config) {}

  void Observe(const scene::Objects& objects);
  void SetFocalLength(double focal_px) { focal_px_ = focal_px; }
  void Forget() { faces_.clear(); }

  /// The face of the hand's person, else the nearest one; nothing when none is known at `now`.
  std::optional<KnownFace> FaceOf(const scene::Hand& hand, Timestamp now) const;
  double PixelsPerMetre(const std::optional<KnownFace>& face) const;
  std::size_t known_faces() const { return faces_.size(); }

 private:
  ImageScaleConfig config_;
  std::map<int, KnownFace> faces_;  // By object id.
  double focal_px_ = 0.0;           // 0 = not known.
};

}  // namespace deixis::gesture_recogniser
