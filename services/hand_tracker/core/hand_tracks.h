#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/config/config.h"
#include "services/hand_tracker/core/hand_track.h"
#include "services/hand_tracker/core/observation.h"

namespace deixis::hand_tracker {

struct HandTracksConfig {
  HandTrackConfig track;
  double gate = 0.35;          ///< Farthest that a hand may be from its prediction, hand lengths
  double gate_speed = 8.0;     ///< ... and how this grows with the time unseen, hand lengths/s.
  double reach = 5.2;          ///< Of an arm, from the face, hand lengths.
  double arm_length = 3.4;     ///< From the shoulder to where a hand begins, at most, hand lengths.
  double least_area = 0.08;    ///< Of a hand, hand lengths squared.
  double largest_area = 0.75;  ///< Of a hand, hand lengths squared.
  double separation = 0.7;     ///< No hand is born closer to another than this, hand lengths.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("track", track);
    v("gate", gate);
    v("gate_speed", gate_speed);
    v("reach", reach);
    v("arm_length", arm_length);
    v("least_area", least_area);
    v("largest_area", largest_area);
    v("separation", separation);
  }
  void Validate() const;
};

/// The hands that are followed: association, birth, merging, occlusion, death.
class HandTracks {
 public:
  explicit HandTracks(const HandTracksConfig& config) : config_(config) {}

  void Update(const Observation& observation);
  void Reset() { tracks_.clear(); }

  const std::vector<HandTrack>& tracks() const { return tracks_; }

 private:
  std::vector<int> Associate(const Observation& observation) const;
  double Cost(const HandTrack& track, const HandCandidate& candidate, double elapsed_s) const;
  void Follow(const Observation& observation, const std::vector<int>& candidate_of);
  void FollowUnseen(const Observation& observation, HandTrack& track);
  void Rejoin();
  void Confirm(const Observation& observation);
  std::vector<HandTrack*> HandsOf(const Observation& observation, const Person* person);
  void RemoveTwins();
  void Bear(const Observation& observation, const std::vector<int>& candidate_of);
  bool IsPlausibleBirth(const Observation& observation, std::size_t candidate) const;

  HandTracksConfig config_;
  std::vector<HandTrack> tracks_;
  int next_id_ = 1;
};

}  // namespace deixis::hand_tracker
