#pragma once
#include <map>
#include <vector>

#include "common/config/config.h"
#include "common/scene/hand.h"
#include "services/hand_tracker/core/hand_tracks.h"
#include "services/hand_tracker/core/people.h"

namespace deixis::hand_tracker {

struct HandRolesConfig {
  double side_rate = 3.0;  ///< How fast a hand's place speaks for its side, nats/(s * hand length).
  double side_limit = 5.0;     ///< Largest log-odds of a side.
  double intent_time_s = 0.7;  ///< Over which motion is summed up to intent.
  double least_speed = 0.8;    ///< Below this no hand is acting, hand lengths/s.
  double switch_ratio = 1.5;   ///< The other hand must be this much livelier to take over.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("side_rate", side_rate);
    v("side_limit", side_limit);
    v("intent_time_s", intent_time_s);
    v("least_speed", least_speed);
    v("switch_ratio", switch_ratio);
  }
  void Validate() const;
};

/// What a hand is to its person.
struct HandRole {
  int person = -1;             ///< Key of the person; -1 = nobody's.
  double left_log_odds = 0.0;  ///< Of being the left hand, from where it was seen so far.
  double side_score = 0.0;     ///< The same after the other hand had its say.
  double speed = 0.0;          ///< Recent mean, hand lengths/s.
  bool is_acting = false;
};

/// Says whose hand a track is, which side, and which of a person's hands is acting.
class HandRoles {
 public:
  explicit HandRoles(const HandRolesConfig& config) : config_(config) {}

  void Update(const std::vector<HandTrack>& tracks, const std::vector<Person>& people, double reach,
              double elapsed_s);
  void Reset() { roles_.clear(); }

  /// Role of the track `id`; a default one for a stranger.
  HandRole RoleOf(int id) const;

 private:
  void FollowTrack(const HandTrack& track, const Person* person, double elapsed_s);
  void SettleSides();
  void ChooseActing();
  const HandRole* Acting(const std::vector<HandRole*>& hands) const;

  HandRolesConfig config_;
  std::map<int, HandRole> roles_;  ///< By track id.
};

}  // namespace deixis::hand_tracker
