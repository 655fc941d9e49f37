#include "services/hand_tracker/core/hand_tracks.h"

#include <algorithm>
#include <cmath>

#include "services/hand_tracker/core/hand_association.h"

namespace deixis::hand_tracker {
namespace {

/// A candidate that a track may share with another hand: near its prediction, and larger than it
/// was.
const HandCandidate* SharedCandidate(const HandTrack& track,
                                     const std::vector<HandCandidate>& candidates) {
  constexpr double kGrowth = 1.3;  // Of a hand's area.
  for (const HandCandidate& candidate : candidates) {
    const bool is_near =
        scene::DistanceTo(candidate.box, track.centre()) < 0.3 * track.hand_length_px();
    const bool holds_both = candidate.area_px > kGrowth * track.latest().area_px;
    if (is_near && holds_both) return &candidate;
  }
  return nullptr;
}

bool IsOnAnyFace(const std::vector<Person>& people, const Eigen::Vector2d& point) {
  return std::any_of(people.begin(), people.end(),
                     [&](const Person& person) { return IsOnFace(person, point); });
}

/// Below the face, between the shoulders: where a neckline shows skin that is no hand.
bool IsOnChest(const Person& person, const Eigen::Vector2d& point) {
  const Eigen::Vector2d offset = (point - scene::Centre(person.face)) / HandLength(person);
  return std::abs(offset.x()) < 0.8 && offset.y() > 0.0 && offset.y() < 1.9;
}

/// How long a track has done without a region of its own.
double LostTime(const HandTrack& track) { return std::max(track.unseen_s(), track.merged_s()); }

/// The one of `hands` that lies so near to the newcomer's shoulder that it is rather the elbow of
/// its arm; nullptr = none.
HandTrack* ElbowBefore(const std::vector<HandTrack*>& hands, const HandTrack& newcomer) {
  constexpr double kUpperArm = 1.5;  // From the shoulder, hand lengths.
  const double bar = kUpperArm * newcomer.hand_length_px();
  if (newcomer.latest().shoulder < 0 || newcomer.latest().shoulder_distance_px < bar)
    return nullptr;
  const auto elbow = std::find_if(hands.begin(), hands.end(), [&](const HandTrack* hand) {
    return hand->latest().shoulder == newcomer.latest().shoulder &&
           hand->latest().shoulder_distance_px < bar;
  });
  return elbow == hands.end() ? nullptr : *elbow;
}

/// Which of a person's `hands` has to make room for `newcomer`; nullptr = none. Two on one arm
/// cannot both be hands: the inner one goes when the other arm shows one. Else the newcomer must be
/// livelier.
HandTrack* Replaced(const std::vector<HandTrack*>& hands, const HandTrack& newcomer) {
  constexpr double kMargin = 0.25;
  HandTrack* weakest = *std::min_element(
      hands.begin(), hands.end(),
      [](const HandTrack* a, const HandTrack* b) { return a->liveliness() < b->liveliness(); });
  if (newcomer.liveliness() > weakest->liveliness() + kMargin) return weakest;
  const int shoulder = newcomer.latest().shoulder;
  const bool is_other_arm =
      shoulder >= 0 && std::all_of(hands.begin(), hands.end(), [&](const HandTrack* hand) {
        return hand->latest().shoulder == 1 - shoulder;
      });
  if (!is_other_arm) return ElbowBefore(hands, newcomer);
  return *std::min_element(hands.begin(), hands.end(), [](const HandTrack* a, const HandTrack* b) {
    return a->latest().shoulder_distance_px < b->latest().shoulder_distance_px;
  });
}

bool IsFreshNewcomer(const HandTrack& track) {
  constexpr double kFreshShare = 0.5;
  return !track.is_confirmed() && track.n_measurements() >= 2 &&
         track.state() == scene::HandState::kMeasured && track.latest().fresh_share > kFreshShare &&
         !track.latest().is_at_face && !track.latest().is_at_shoulder;
}

/// How dear it is to say that `newcomer` is where the hand of `track` went, hand lengths; infinite
/// when it cannot be.
double RejoinCost(const HandTrack& track, const HandTrack& newcomer) {
  constexpr double kFastest = 22.0;  // Hand lengths/s: about 4 m/s.
  constexpr double kLongest_s = 0.5;
  constexpr double kOtherArmCost = 1.5;
  const double gone_s = std::max(LostTime(track), track.still_s());
  const bool is_gone = LostTime(track) > 0.0 || track.latest().is_at_face ||
                       (track.still_s() > 0.0 && track.still_s() < kLongest_s);
  const double distance = (track.centre() - newcomer.centre()).norm() / newcomer.hand_length_px();
  if (!is_gone || distance > 1.0 + kFastest * std::min(gone_s, kLongest_s)) return kForbidden;
  const bool is_same_arm = track.latest().shoulder == newcomer.latest().shoulder;
  return distance + (is_same_arm ? 0.0 : kOtherArmCost);
}

/// The confirmed track whose hand `newcomer` most likely is; nullptr = none.
HandTrack* LostBefore(std::vector<HandTrack>& tracks, const HandTrack& newcomer) {
  HandTrack* best = nullptr;
  double least = kForbidden;
  for (HandTrack& track : tracks) {
    const double cost = track.is_confirmed() ? RejoinCost(track, newcomer) : kForbidden;
    if (cost < least) {
      least = cost;
      best = &track;
    }
  }
  return best;
}

}  // namespace

void HandTracksConfig::Validate() const {
  track.Validate();
  config::Faults faults;
  faults.Require(gate > 0.0, "gate", "must be positive");
  faults.Require(gate_speed > 0.0, "gate_speed", "must be positive");
  faults.Require(reach > 0.0, "reach", "must be positive");
  faults.Require(arm_length > 0.0, "arm_length", "must be positive");
  faults.Require(least_area > 0.0, "least_area", "must be positive");
  faults.Require(largest_area > least_area, "largest_area", "must exceed least_area");
  faults.Require(separation >= 0.0, "separation", "must not be negative");
  faults.ThrowIfAny();
}

void HandTracks::Update(const Observation& observation) {
  for (HandTrack& track : tracks_) track.Predict(observation.elapsed_s);
  const std::vector<int> candidate_of = Associate(observation);
  Follow(observation, candidate_of);
  Bear(observation, candidate_of);
  Rejoin();
  Confirm(observation);
  RemoveTwins();
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(),
                               [](const HandTrack& track) { return track.IsOver(); }),
                tracks_.end());
}

double HandTracks::Cost(const HandTrack& track, const HandCandidate& candidate,
                        double elapsed_s) const {
  constexpr double kAreaCost = 2.0;
  constexpr double kShoulderCost = 9.0;
  constexpr double kStillCost = 20.0;
  constexpr double kLongest_s = 0.4;
  constexpr double kStaleCost = 20.0;  // What a moving hand uncovers keeps still.
  const double distance = (candidate.centre - track.centre()).norm() / track.hand_length_px();
  const bool may_have_come_far = candidate.moving_share > config_.track.moving_share &&
                                 candidate.fresh_share > 0.0 && !candidate.is_at_face;
  const double unseen_s =
      may_have_come_far ? std::min(LostTime(track) + elapsed_s, kLongest_s) : elapsed_s;
  if (distance > config_.gate + config_.gate_speed * unseen_s) return kForbidden;
  if (candidate.area_px >
      1.3 * config_.largest_area * candidate.hand_length_px * candidate.hand_length_px) {
    return kForbidden;
  }
  const double squared = track.SquaredDistance(candidate.centre);
  const double area_ratio =
      std::log(std::max(1.0, candidate.area_px) / std::max(1.0, track.latest().area_px));
  return squared + kAreaCost * area_ratio * area_ratio +
         (candidate.is_at_shoulder ? kShoulderCost : 0.0) +
         (track.still_s() > 0.0 ? 0.0 : kStaleCost * (1.0 - candidate.fresh_share)) +
         kStillCost * std::max(0.0, config_.track.moving_share - candidate.moving_share);
}

std::vector<int> HandTracks::Associate(const Observation& observation) const {
  constexpr double kUnassignedCost = 400.0;
  constexpr double kLostCost = 20.0;       // A hand in sight keeps its region.
  constexpr double kTentativeCost = 60.0;  // Hands that are known choose first.
  Eigen::MatrixXd costs(static_cast<Eigen::Index>(tracks_.size()),
                        static_cast<Eigen::Index>(observation.candidates.size()));
  for (Eigen::Index row = 0; row < costs.rows(); ++row) {
    const HandTrack& track = tracks_[static_cast<std::size_t>(row)];
    for (Eigen::Index column = 0; column < costs.cols(); ++column) {
      costs(row, column) =
          std::min(Cost(track, observation.candidates[static_cast<std::size_t>(column)],
                        observation.elapsed_s),
                   kForbidden) +
          (track.is_confirmed() ? 0.0 : kTentativeCost) + (LostTime(track) > 0.0 ? kLostCost : 0.0);
    }
  }
  return Assign(costs, kUnassignedCost);
}

void HandTracks::Follow(const Observation& observation, const std::vector<int>& candidate_of) {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (candidate_of[i] >= 0) {
      const auto candidate = static_cast<std::size_t>(candidate_of[i]);
      tracks_[i].Measure(observation.candidates[candidate], observation.elapsed_s);
    } else {
      FollowUnseen(observation, tracks_[i]);
    }
  }
}

void HandTracks::FollowUnseen(const Observation& observation, HandTrack& track) {
  const HandCandidate* shared = SharedCandidate(track, observation.candidates);
  if (shared != nullptr) {
    track.Merge(shared->centre, 0.4 * track.hand_length_px(), observation.elapsed_s);
  } else if (IsOnAnyFace(observation.people, track.centre())) {
    track.Merge(track.centre(), 0.4 * track.hand_length_px(), observation.elapsed_s);
  } else {
    track.Miss(observation.elapsed_s);
  }
}

bool HandTracks::IsPlausibleBirth(const Observation& observation, std::size_t candidate) const {
  const HandCandidate& hand = observation.candidates[candidate];
  const double unit = hand.hand_length_px;
  const double area = hand.area_px / (unit * unit);
  if (hand.root_distance_px > config_.arm_length * unit) return false;  // A leg.
  if (hand.is_at_shoulder || area < config_.least_area || area > config_.largest_area) return false;
  for (const HandTrack& track : tracks_) {
    if ((track.centre() - hand.centre).norm() < config_.separation * unit) return false;
  }
  if (observation.people.empty()) return true;
  const Person* person = NearestPerson(observation.people, hand.centre, config_.reach);
  return person != nullptr && !IsOnChest(*person, hand.centre) && !hand.is_at_face;
}

void HandTracks::Bear(const Observation& observation, const std::vector<int>& candidate_of) {
  const std::size_t n_followed = candidate_of.size();
  std::vector<bool> is_taken(observation.candidates.size(), false);
  for (std::size_t i = 0; i < n_followed; ++i) {
    if (candidate_of[i] >= 0) is_taken[static_cast<std::size_t>(candidate_of[i])] = true;
  }
  for (std::size_t i = 0; i < observation.candidates.size(); ++i) {
    if (is_taken[i] || !IsPlausibleBirth(observation, i)) continue;
    tracks_.emplace_back(next_id_++, config_.track, observation.candidates[i]);
  }
}

/// A hand that moves too fast to be followed leaves its track on what it uncovered, on the face
/// that it passed, or nowhere. Where something that moves appears within its reach right then, it
/// is there.
void HandTracks::Rejoin() {
  for (std::size_t i = tracks_.size(); i-- > 0;) {
    if (!IsFreshNewcomer(tracks_[i])) continue;
    HandTrack* lost = LostBefore(tracks_, tracks_[i]);
    if (lost == nullptr) continue;
    lost->ContinueAs(tracks_[i]);
    tracks_.erase(tracks_.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

/// A person has two hands: a newcomer takes the place of the weaker one only if it is clearly
/// livelier.
void HandTracks::Confirm(const Observation& observation) {
  for (HandTrack& track : tracks_) {
    const Person* person = NearestPerson(observation.people, track.centre(), config_.reach);
    if (track.is_confirmed() || track.credit() < config_.track.confirm_credit) continue;
    const std::vector<HandTrack*> hands = HandsOf(observation, person);
    HandTrack* replaced = hands.size() < 2 ? nullptr : Replaced(hands, track);
    if (hands.size() >= 2 && replaced == nullptr) continue;
    if (replaced != nullptr) replaced->Dismiss();
    track.Confirm();
  }
}

/// The hands confirmed for `person` (nullptr = for nobody).
std::vector<HandTrack*> HandTracks::HandsOf(const Observation& observation, const Person* person) {
  std::vector<HandTrack*> hands;
  for (HandTrack& track : tracks_) {
    if (track.is_confirmed() &&
        NearestPerson(observation.people, track.centre(), config_.reach) == person) {
      hands.push_back(&track);
    }
  }
  return hands;
}

/// Two tracks of one hand: the older one stays.
void HandTracks::RemoveTwins() {
  constexpr double kTwinDistance = 0.35;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    for (std::size_t j = tracks_.size() - 1; j > i; --j) {
      const bool is_pair = tracks_[i].is_confirmed() && tracks_[j].is_confirmed();
      const double distance = (tracks_[i].centre() - tracks_[j].centre()).norm();
      if (!is_pair && distance < kTwinDistance * tracks_[i].hand_length_px()) {
        tracks_.erase(tracks_.begin() + static_cast<std::ptrdiff_t>(j));
      }
    }
  }
}

}  // namespace deixis::hand_tracker
