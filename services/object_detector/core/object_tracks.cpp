#include "services/object_detector/core/object_tracks.h"

#include <algorithm>
#include <utility>

namespace deixis::object_detector {
namespace {

constexpr double kSamePlace = 0.2;    // Overlap from which two boxes mean one object.
constexpr double kScoreMemory = 0.9;  // Share of the old score per picture.

scene::Box Mix(const scene::Box& old, const scene::Box& found, double old_share) {
  const auto mix = [old_share](double a, double b) {
    return old_share * a + (1.0 - old_share) * b;
  };
  return {mix(old.x_px, found.x_px), mix(old.y_px, found.y_px), mix(old.width_px, found.width_px),
          mix(old.height_px, found.height_px)};
}

}  // namespace

void TrackingConfig::Check(config::Faults& faults) const {
  faults.Require(confirming_hits >= 1, "cascades.tracking.confirming_hits", "must be at least 1");
  faults.Require(early_misses >= 0, "cascades.tracking.early_misses", "must not be negative");
  faults.Require(memory_s >= 0.0, "cascades.tracking.memory_s", "must not be negative");
  faults.Require(smoothing >= 0.0 && smoothing < 1.0, "cascades.tracking.smoothing",
                 "must lie in 0..1, below 1");
  faults.Require(max_tracks >= 1 && max_tracks <= 100, "cascades.tracking.max_tracks",
                 "must lie in 1..100");
}

ObjectTracks::ObjectTracks(const TrackingConfig& config, std::function<int()> new_id)
    : config_(config), new_id_(std::move(new_id)) {}

void ObjectTracks::Forget(Timestamp now) {
  const auto is_old = [this, now](const ObjectTrack& track) {
    return SecondsBetween(track.last_seen, now) > config_.memory_s;
  };
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), is_old), tracks_.end());
}

void ObjectTracks::Hit(ObjectTrack& track, const scene::Box& box, Timestamp time) {
  const bool is_fresh = track.hits == 0 || track.misses_in_a_row > config_.early_misses;
  track.box = is_fresh ? box : Mix(track.box, box, config_.smoothing);
  track.last_seen = time;
  track.misses_in_a_row = 0;
  ++track.hits;
  track.score = track.hits == 1 ? 1.0 : kScoreMemory * track.score + (1.0 - kScoreMemory);
  if (!track.is_confirmed() && track.hits >= config_.confirming_hits) track.id = new_id_();
}

void ObjectTracks::Miss(ObjectTrack& track) {
  ++track.misses_in_a_row;
  track.score *= kScoreMemory;
}

void ObjectTracks::Propose(const scene::Box& box, Timestamp time) {
  for (ObjectTrack& track : tracks_) {
    if (scene::Overlap(track.box, box) < kSamePlace) continue;
    if (track.misses_in_a_row > 0) Hit(track, box, time);
    return;
  }
  if (static_cast<int>(tracks_.size()) >= config_.max_tracks) return;
  tracks_.emplace_back();
  Hit(tracks_.back(), box, time);
}

void ObjectTracks::Tidy() {
  std::vector<ObjectTrack> kept;
  for (const ObjectTrack& track : tracks_) {
    const bool is_spurious = !track.is_confirmed() && track.misses_in_a_row > config_.early_misses;
    const bool is_double =
        std::any_of(kept.begin(), kept.end(), [&track](const ObjectTrack& other) {
          return scene::Overlap(other.box, track.box) > kSamePlace;
        });
    if (!is_spurious && !is_double) kept.push_back(track);
  }
  tracks_ = std::move(kept);
}

}  // namespace deixis::object_detector
