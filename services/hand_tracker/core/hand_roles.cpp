#include "services/hand_tracker/core/hand_roles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace deixis::hand_tracker {

void HandRolesConfig::Validate() const {
  config::Faults faults;
  faults.Require(side_rate > 0.0, "side_rate", "must be positive");
  faults.Require(side_limit > 0.0, "side_limit", "must be positive");
  faults.Require(intent_time_s > 0.0, "intent_time_s", "must be positive");
  faults.Require(least_speed > 0.0, "least_speed", "must be positive");
  faults.Require(switch_ratio >= 1.0, "switch_ratio", "must be at least 1");
  faults.ThrowIfAny();
}

void HandRoles::Update(const std::vector<HandTrack>& tracks, const std::vector<Person>& people,
                       double reach, double elapsed_s) {
  std::set<int> alive;
  for (const HandTrack& track : tracks) {
    alive.insert(track.id());
    FollowTrack(track, NearestPerson(people, track.centre(), reach), elapsed_s);
  }
  for (auto role = roles_.begin(); role != roles_.end();) {
    role = alive.count(role->first) > 0 ? std::next(role) : roles_.erase(role);
  }
  SettleSides();
  ChooseActing();
}

void HandRoles::FollowTrack(const HandTrack& track, const Person* person, double elapsed_s) {
  const bool is_new = roles_.count(track.id()) == 0;
  HandRole& role = roles_[track.id()];
  const double speed = track.velocity().norm() / track.hand_length_px();
  role.speed += (1.0 - std::exp(-elapsed_s / config_.intent_time_s)) * (speed - role.speed);
  if (person == nullptr) return;
  role.person = person->key;
  // A person who faces the camera has the left hand at the image's right.
  const double aside = (track.centre().x() - scene::Centre(person->face).x()) / HandLength(*person);
  const double weight = config_.side_rate * std::clamp(aside, -1.5, 1.5);
  role.left_log_odds = std::clamp(role.left_log_odds + weight * (is_new ? 0.3 : elapsed_s),
                                  -config_.side_limit, config_.side_limit);
}

/// Of two hands of a person one is the left and one the right: the pairing that fits better wins.
void HandRoles::SettleSides() {
  for (auto& [id, role] : roles_) {
    role.side_score = role.left_log_odds;
    if (role.person < 0) continue;
    const HandRole* strongest = nullptr;
    for (const auto& [other_id, other] : roles_) {
      if (other_id == id || other.person != role.person) continue;
      if (strongest == nullptr ||
          std::abs(other.left_log_odds) > std::abs(strongest->left_log_odds)) {
        strongest = &other;
      }
    }
    if (strongest != nullptr) role.side_score -= strongest->left_log_odds;
  }
}

void HandRoles::ChooseActing() {
  std::map<int, std::vector<HandRole*>> hands_of;
  for (auto& [id, role] : roles_) hands_of[role.person].push_back(&role);
  for (const auto& [person, hands] : hands_of) {
    const HandRole* chosen = Acting(hands);
    for (HandRole* role : hands) role->is_acting = role == chosen;
  }
}

/// The one of a person's `hands` that acts; nullptr = none does, and none did.
const HandRole* HandRoles::Acting(const std::vector<HandRole*>& hands) const {
  const HandRole* liveliest = nullptr;
  const HandRole* acting = nullptr;
  for (const HandRole* role : hands) {
    if (liveliest == nullptr || role->speed > liveliest->speed) liveliest = role;
    if (role->is_acting && (acting == nullptr || role->speed > acting->speed)) acting = role;
  }
  const double bar = acting != nullptr && acting != liveliest
                         ? std::max(config_.least_speed, config_.switch_ratio * acting->speed)
                         : config_.least_speed;
  return liveliest->speed > bar ? liveliest : acting;
}

HandRole HandRoles::RoleOf(int id) const {
  const auto role = roles_.find(id);
  return role == roles_.end() ? HandRole{} : role->second;
}

}  // namespace deixis::hand_tracker
