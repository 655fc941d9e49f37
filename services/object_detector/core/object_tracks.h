#pragma once
#include <functional>
#include <vector>

#include "common/config/config.h"
#include "common/scene/box.h"
#include "common/time/timestamp.h"

namespace deixis::object_detector {

struct TrackingConfig {
  int confirming_hits = 3;  ///< Pictures that must show a new object before it is told.
  int early_misses = 2;     ///< Pictures in a row that may miss it before that.
  double memory_s = 3.0;    ///< How long an object that is not found is kept.
  double smoothing = 0.5;   ///< Share of the old box in the new one, 0 = take what was found.
  int max_tracks = 8;       ///< More objects than this are not followed.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("confirming_hits", confirming_hits);
    v("early_misses", early_misses);
    v("memory_s", memory_s);
    v("smoothing", smoothing);
    v("max_tracks", max_tracks);
  }
  void Check(config::Faults& faults) const;
};

/// One object over time.
struct ObjectTrack {
  int id = -1;     ///< -1 until it is confirmed.
  scene::Box box;  ///< Smoothed; the last one known while it is not found.
  Timestamp last_seen;
  int hits = 0;
  int misses_in_a_row = 0;
  double score = 0.0;  ///< Running share of pictures that showed it.

  bool is_confirmed() const { return id >= 0; }
};

/// Which objects there are: new ones have to be seen a few times before they count, known ones are
/// kept for a while when they are not found.
class ObjectTracks {
 public:
  ObjectTracks(const TrackingConfig& config, std::function<int()> new_id);

  /// Drops what was not seen for too long before `now`.
  void Forget(Timestamp now);
  void Hit(ObjectTrack& track, const scene::Box& box, Timestamp time);
  void Miss(ObjectTrack& track);
  /// Begins a track unless an object is known at that place (then it is a hit, if it was missed) or
  /// there are too many.
  void Propose(const scene::Box& box, Timestamp time);
  /// Drops new objects that were missed too often, and the younger of two at the same place.
  void Tidy();
  void Reset() { tracks_.clear(); }

  std::vector<ObjectTrack>& tracks() { return tracks_; }  ///< Oldest first.

 private:
  TrackingConfig config_;
  std::function<int()> new_id_;
  std::vector<ObjectTrack> tracks_;
};

}  // namespace deixis::object_detector
