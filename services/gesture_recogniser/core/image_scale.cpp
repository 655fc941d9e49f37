#include "services/gesture_recogniser/core/image_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "services/gesture_recogniser/core/forgetting.h"

namespace deixis::gesture_recogniser {

void ImageScaleConfig::Validate() const {
  config::Faults faults;
  faults.Require(face_height_m >= 0.01 && face_height_m <= 10.0, "face_height_m",
                 "must lie in [0.01, 10]");
  faults.Require(assumed_distance_m >= 0.1 && assumed_distance_m <= 1000.0, "assumed_distance_m",
                 "must lie in [0.1, 1000]");
  faults.Require(fixed_px_per_m >= 0.1 && fixed_px_per_m <= 1e6, "fixed_px_per_m",
                 "must lie in [0.1, 1e6]");
  faults.Require(smoothing_s >= 0.0, "smoothing_s", "must not be negative");
  faults.Require(face_memory_s >= 0.0, "face_memory_s", "must not be negative");
  faults.ThrowIfAny();
}

void ImageScale::Observe(const scene::Objects& objects) {
  ForgetOlder(faces_, objects.time, config_.face_memory_s);
  for (const scene::Object& object : objects.objects) {
    if (object.kind != scene::ObjectKind::kFace || !object.box || object.box->height_px <= 0.0) {
      continue;
    }
    const auto [known, is_new] = faces_.try_emplace(
        object.id, KnownFace{*object.box, object.box->height_px, object.person_id, objects.time});
    if (is_new) continue;
    KnownFace& face = known->second;
    const double elapsed_s = std::max(0.0, SecondsBetween(face.last_seen, objects.time));
    const double share =
        config_.smoothing_s > 0.0 ? 1.0 - std::exp(-elapsed_s / config_.smoothing_s) : 1.0;
    face.height_px += share * (object.box->height_px - face.height_px);
    face.box = *object.box;
    face.person_id = object.person_id;
    face.last_seen = objects.time;
  }
}

std::optional<KnownFace> ImageScale::FaceOf(const scene::Hand& hand, Timestamp now) const {
  std::optional<KnownFace> nearest;
  double least_px = std::numeric_limits<double>::infinity();
  for (const auto& [id, face] : faces_) {
    if (std::abs(SecondsBetween(face.last_seen, now)) > config_.face_memory_s) continue;
    if (hand.person_id >= 0 && face.person_id == hand.person_id) return face;
    const double distance_px = (scene::Centre(face.box) - hand.centre_px).norm();
    if (distance_px < least_px) {
      least_px = distance_px;
      nearest = face;
    }
  }
  return nearest;
}

scene::Box InMetres(const scene::Box& box, double px_per_m) {
  return {box.x_px / px_per_m, box.y_px / px_per_m, box.width_px / px_per_m,
          box.height_px / px_per_m};
}

double ImageScale::PixelsPerMetre(const std::optional<KnownFace>& face) const {
  if (config_.source == ScaleSource::kFace && face) return face->height_px / config_.face_height_m;
  if (config_.source != ScaleSource::kFixed && focal_px_ > 0.0) {
    return focal_px_ / config_.assumed_distance_m;
  }
  return config_.fixed_px_per_m;
}

}  // namespace deixis::gesture_recogniser
