#pragma once
#include <array>
#include <optional>
#include <vector>

#include "common/config/config.h"
#include "services/hand_tracker/core/hand_paths.h"
#include "services/hand_tracker/core/hand_track.h"
#include "services/hand_tracker/core/observation.h"

namespace deixis::hand_tracker {

struct HandTracksConfig {
  HandTrackConfig track;
  HandPathsConfig paths;
  double reach = 5.2;  ///< Of an arm, from the face, hand lengths.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("track", track);
    v("paths", paths);
    v("reach", reach);
  }
  void Validate() const;
};

/// The hands that are followed: at most two of each person, or two of anybody while no face is
/// known.
class HandTracks {
 public:
  explicit HandTracks(const HandTracksConfig& config) : config_(config) {}

  void Update(const Observation& observation);
  void Reset();

  const std::vector<HandTrack>& tracks() const { return tracks_; }

 private:
  /// The two hands of somebody.
  struct Pair {
    int person_key = kNobody;
    HandPaths paths;
    std::array<int, 2> track_ids{kNone, kNone};
  };
  static constexpr int kNobody = -1;
  static constexpr int kNone = -1;

  void FindPairs(const std::vector<Person>& people);
  void Follow(const Observation& observation, const Person* person, Pair& pair);
  void Follow(const Observation& observation, const std::array<HandGuess, 2>& hands,
              std::size_t side, const std::vector<HandCandidate>& candidates, int& id);
  void FollowUnseen(const Observation& observation, const HandGuess& guess, HandTrack& track);
  void ChangeSides(Pair& pair);
  HandTrack* Find(int id);
  void Forget(int& id);

  HandTracksConfig config_;
  std::vector<Pair> pairs_;
  std::vector<HandTrack> tracks_;
  int next_id_ = 1;
};

}  // namespace deixis::hand_tracker
