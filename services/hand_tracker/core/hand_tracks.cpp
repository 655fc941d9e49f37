#include "services/hand_tracker/core/hand_tracks.h"

#include <algorithm>
#include <utility>

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

/// The candidates of the person with index `person`, -1 = of nobody.
std::vector<HandCandidate> CandidatesOf(const Observation& observation, int person) {
  std::vector<HandCandidate> candidates;
  for (const HandCandidate& candidate : observation.candidates) {
    if (candidate.person == person) candidates.push_back(candidate);
  }
  return candidates;
}

}  // namespace

void HandTracksConfig::Validate() const {
  config::Faults faults;
  faults.Require(reach > 0.0, "reach", "must be positive");
  faults.ThrowIfAny();
}

void HandTracks::Reset() {
  pairs_.clear();
  tracks_.clear();
}

void HandTracks::Update(const Observation& observation) {
  FindPairs(observation.people);
  for (HandTrack& track : tracks_) track.Predict(observation.elapsed_s);
  for (Pair& pair : pairs_) {
    const auto person =
        std::find_if(observation.people.begin(), observation.people.end(),
                     [&pair](const Person& other) { return other.key == pair.person_key; });
    Follow(observation, person == observation.people.end() ? nullptr : &*person, pair);
  }
}

/// One pair of hands for each person. Hands found before any face was are the first person's; those
/// of the last person who is known no more are anybody's.
void HandTracks::FindPairs(const std::vector<Person>& people) {
  const auto is_gone = [&people](const Pair& pair) {
    return std::none_of(people.begin(), people.end(),
                        [&pair](const Person& person) { return person.key == pair.person_key; });
  };
  std::vector<Pair> left;
  for (Pair& pair : pairs_) {
    if (is_gone(pair)) left.push_back(std::move(pair));
  }
  pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(), is_gone), pairs_.end());
  std::vector<int> keys;
  for (const Person& person : people) keys.push_back(person.key);
  if (keys.empty()) keys.push_back(kNobody);
  for (const int key : keys) {
    const bool has_pair = std::any_of(pairs_.begin(), pairs_.end(),
                                      [key](const Pair& pair) { return pair.person_key == key; });
    if (has_pair) continue;
    if (left.empty()) {
      pairs_.push_back({key, HandPaths(config_.paths), {kNone, kNone}});
    } else {
      pairs_.push_back(std::move(left.front()));
      pairs_.back().person_key = key;
      left.erase(left.begin());
    }
  }
  for (Pair& pair : left) {
    for (int& id : pair.track_ids) Forget(id);
  }
}

void HandTracks::Follow(const Observation& observation, const Person* person, Pair& pair) {
  const int index = person == nullptr ? -1 : static_cast<int>(person - observation.people.data());
  const std::vector<HandCandidate> candidates = CandidatesOf(observation, index);
  pair.paths.Update(candidates, person, observation.elapsed_s);
  ChangeSides(pair);
  for (std::size_t side = 0; side < pair.track_ids.size(); ++side) {
    Follow(observation, pair.paths.hands(), side, candidates, pair.track_ids[side]);
  }
}

/// A lone hand that turns out to be the other one keeps its track.
void HandTracks::ChangeSides(Pair& pair) {
  constexpr double kNear = 1.0;  // Hand lengths.
  for (std::size_t side = 0; side < pair.track_ids.size(); ++side) {
    const HandGuess& there = pair.paths.hands()[1 - side];
    const HandTrack* track = Find(pair.track_ids[side]);
    if (track == nullptr || pair.track_ids[1 - side] != kNone) continue;
    const bool has_left = pair.paths.hands()[side].kind == HandGuess::Kind::kAbsent;
    if (has_left && there.candidate >= 0 &&
        (there.sight.position - track->centre()).norm() < kNear * track->hand_length_px()) {
      std::swap(pair.track_ids[0], pair.track_ids[1]);
      return;
    }
  }
}

void HandTracks::Follow(const Observation& observation, const std::array<HandGuess, 2>& hands,
                        std::size_t side, const std::vector<HandCandidate>& candidates, int& id) {
  const HandGuess& guess = hands[side];
  const bool is_shared = guess.candidate == hands[1 - side].candidate;
  if (guess.kind == HandGuess::Kind::kAbsent) {
    Forget(id);
    return;
  }
  HandTrack* track = Find(id);
  if (guess.kind == HandGuess::Kind::kUnseen) {
    if (track != nullptr) FollowUnseen(observation, guess, *track);
    return;
  }
  const HandCandidate& candidate = candidates[static_cast<std::size_t>(guess.candidate)];
  if (track != nullptr) {
    track->Measure(candidate, is_shared ? HandTrack::Sight::kShared : HandTrack::Sight::kAlone);
  } else {
    id = next_id_++;
    tracks_.emplace_back(id, config_.track, candidate);
  }
}

void HandTracks::FollowUnseen(const Observation& observation, const HandGuess& guess,
                              HandTrack& track) {
  constexpr double kSharedSigma = 0.4;  // Of a hand within something larger, hand lengths.
  const double sigma_px = kSharedSigma * track.hand_length_px();
  const HandCandidate* shared = SharedCandidate(track, observation.candidates);
  if (shared != nullptr) {
    track.Merge(shared->centre, sigma_px, guess.sight.elapsed_s, observation.elapsed_s);
  } else if (IsOnAnyFace(observation.people, track.centre())) {
    track.Merge(track.centre(), sigma_px, guess.sight.elapsed_s, observation.elapsed_s);
  } else {
    track.Miss(guess.sight.elapsed_s, observation.elapsed_s);
  }
}

HandTrack* HandTracks::Find(int id) {
  const auto track = std::find_if(tracks_.begin(), tracks_.end(),
                                  [id](const HandTrack& other) { return other.id() == id; });
  return track == tracks_.end() ? nullptr : &*track;
}

void HandTracks::Forget(int& id) {
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(),
                               [id](const HandTrack& track) { return track.id() == id; }),
                tracks_.end());
  id = kNone;
}

}  // namespace deixis::hand_tracker
