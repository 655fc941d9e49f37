#include "services/gesture_recogniser/core/pointing_recogniser.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "services/gesture_recogniser/core/forgetting.h"

namespace deixis::gesture_recogniser {
namespace {

constexpr double kLeavesHold_m = 0.06;  // A gesture ends when the hand has left its hold this far.
constexpr double kLeastCandidate = 0.01;
// The longest stroke of usual models, which lies before the hold in the history.
constexpr double kLongestStroke_s = 1.2;

double Sigma(const scene::Hand& hand) {
  const double variance = 0.5 * (hand.covariance(0, 0) + hand.covariance(1, 1));
  return std::isfinite(variance) && variance > 0.0 ? std::sqrt(variance) : 1.0;
}

/// Not before the first time that there is, 0.
Timestamp Before(Timestamp now, double seconds) {
  const auto earlier = static_cast<std::int64_t>(std::llround(1e6 * seconds));
  return {std::max<std::int64_t>(0, now.microseconds - earlier)};
}

bool CanBePointedAt(const scene::Object& object) {
  return object.kind != scene::ObjectKind::kFace && object.box.has_value();
}

bool IsAmong(const scene::Hands& hands, int id) {
  return std::any_of(hands.hands.begin(), hands.hands.end(),
                     [id](const scene::Hand& hand) { return hand.id == id; });
}

/// Whether two person ids may be one person's; -1 = not known.
bool MayBeSamePerson(int person, int other) { return person < 0 || other < 0 || person == other; }

std::unique_ptr<HandRecogniser> MakeRecogniser(const PointingRecogniserConfig& config,
                                               const std::vector<GestureModel>& models,
                                               int hand_id) {
  switch (config.method) {
    case Method::kSegmental:
      return std::make_unique<Segmental>(config.segmental, models, config.motion.step_s);
    case Method::kAsPrinted:
      return std::make_unique<Condensation>(config.as_printed, models,
                                            static_cast<std::uint64_t>(hand_id));
  }
  throw std::logic_error("unknown method");
}

}  // namespace

void PointingRecogniserConfig::Validate() const {
  config::Faults faults;
  faults.Require(objects_memory_s > 0.0, "objects_memory_s", "must be positive");
  faults.Require(longest_gap_s > 0.0, "longest_gap_s", "must be positive");
  faults.Require(rejoin_speed_m_per_s >= 0.0, "rejoin_speed_m_per_s", "must not be negative");
  faults.Require(segmental.hold.longest_s + kLongestStroke_s <= motion.history_s,
                 "motion.history_s", "must exceed segmental.hold.longest_s by 1.2 s");
  faults.ThrowIfAny();
}

PointingRecogniser::PointingRecogniser(const PointingRecogniserConfig& config,
                                       const std::vector<GestureModel>& models)
    : config_(config), models_(models), scale_(config.scale) {
  if (models.empty()) throw config::ConfigError("'models' must name at least one gesture model");
  MakeRecogniser(config_, models_, 0);  // Models that do not fit are refused now, not at a hand.
}

void PointingRecogniser::ObserveObjects(const scene::Objects& objects) {
  has_objects_ = true;
  scale_.Observe(objects);
  ForgetOlder(objects_, objects.time, config_.objects_memory_s);
  for (const scene::Object& object : objects.objects) {
    if (!CanBePointedAt(object)) continue;
    scene::Object& known = objects_[object.id];
    known = object;
    known.last_seen = objects.time;
  }
}

Recognition PointingRecogniser::ObserveHands(const scene::Hands& hands) {
  Recognition result;
  ForgetIfTimeJumps(hands.time, result);
  result.state.time = hands.time;
  result.state.camera = hands.camera;
  result.state.frame = hands.frame;
  for (const scene::Hand& hand : hands.hands) {
    if (hand.centre_px.allFinite()) Judge(hand, hands, result);
  }
  ForgetLostHands(hands, result);
  return result;
}

void PointingRecogniser::ForgetIfTimeJumps(Timestamp now, Recognition& result) {
  const double elapsed_s = has_time_ ? SecondsBetween(last_time_, now) : 0.0;
  if (elapsed_s < 0.0 || elapsed_s > config_.longest_gap_s) {
    for (auto& [id, track] : hands_) End(track, last_time_, result);
    hands_.clear();
  }
  if (elapsed_s < 0.0) {
    objects_.clear();
    scale_.Forget();
  }
  last_time_ = now;
  has_time_ = true;
}

void PointingRecogniser::ForgetLostHands(const scene::Hands& hands, Recognition& result) {
  for (auto track = hands_.begin(); track != hands_.end();) {
    const double unseen_s = SecondsBetween(track->second.last_seen, hands.time);
    if (unseen_s > config_.motion.longest_gap_s) {
      End(track->second, hands.time, result);
      track = hands_.erase(track);
    } else {
      ++track;
    }
  }
}

PointingRecogniser::TrackedHand& PointingRecogniser::Track(const scene::Hand& hand,
                                                           const scene::Hands& hands,
                                                           double px_per_m) {
  if (hands_.count(hand.id) == 0) Rejoin(hand, hands, px_per_m);
  auto known = hands_.find(hand.id);
  if (known == hands_.end()) {
    TrackedHand fresh(config_.motion, MakeRecogniser(config_, models_, hand.id));
    known = hands_.emplace(hand.id, std::move(fresh)).first;
  }
  known->second.last_seen = hands.time;
  known->second.person_id = hand.person_id;
  return known->second;
}

/// Trackers lose fast hands and find them again under a new id: the nearest lost hand that could
/// have come here goes on under the new one.
void PointingRecogniser::Rejoin(const scene::Hand& hand, const scene::Hands& hands,
                                double px_per_m) {
  auto nearest = hands_.end();
  double least_px = std::numeric_limits<double>::infinity();
  for (auto track = hands_.begin(); track != hands_.end(); ++track) {
    const auto sight = track->second.history.LastSight();
    if (!sight || IsAmong(hands, track->first)) continue;
    if (!MayBeSamePerson(track->second.person_id, hand.person_id)) continue;
    const double gap_s = SecondsBetween(sight->time, hands.time);
    const double distance_px = (sight->position_px - hand.centre_px).norm();
    const double reach_px = config_.rejoin_speed_m_per_s * px_per_m * gap_s;
    if (gap_s > config_.motion.longest_gap_s || distance_px > std::min(reach_px, least_px))
      continue;
    least_px = distance_px;
    nearest = track;
  }
  if (nearest == hands_.end()) return;
  auto node = hands_.extract(nearest);
  node.key() = hand.id;
  hands_.insert(std::move(node));
}

void PointingRecogniser::Judge(const scene::Hand& hand, const scene::Hands& hands,
                               Recognition& result) {
  if (config_.hands == HandChoice::kActing && !hand.is_acting) return;
  const double px_per_m = scale_.PixelsPerMetre(scale_.FaceOf(hand, hands.time));
  TrackedHand& track = Track(hand, hands, px_per_m);
  track.history.Add(
      {hands.time, hand.centre_px, Sigma(hand), hand.state == scene::HandState::kMeasured});
  Surround(hand, hands.time, px_per_m);
  const Assessment& assessment =
      track.recogniser->Observe(track.history.Sample(px_per_m), surroundings_, hand.side);
  result.state.hypotheses.push_back(Hypothesis(hand, assessment, px_per_m));
  const bool has_left = (hand.centre_px - track.held_px).norm() > kLeavesHold_m * px_per_m;
  if (has_left || assessment.decision) End(track, hands.time, result);
  if (!assessment.decision) return;
  track.open = Begin(hand, hands.time, assessment);
  track.held_px = hand.centre_px;
  result.gestures.push_back(*track.open);
}

void PointingRecogniser::Surround(const scene::Hand& hand, Timestamp now, double px_per_m) {
  surroundings_.targets.clear();
  for (const auto& [id, object] : objects_) {
    if (std::abs(SecondsBetween(object.last_seen, now)) > config_.objects_memory_s) continue;
    surroundings_.targets.push_back({id, object.label, InMetres(*object.box, px_per_m)});
  }
  surroundings_.face_m.reset();
  if (const auto face = scale_.FaceOf(hand, now)) {
    surroundings_.face_m = InMetres(face->box, px_per_m);
  }
}

scene::GestureHypothesis PointingRecogniser::Hypothesis(const scene::Hand& hand,
                                                        const Assessment& assessment,
                                                        double px_per_m) const {
  scene::GestureHypothesis hypothesis;
  hypothesis.hand_id = hand.id;
  hypothesis.person_id = hand.person_id;
  hypothesis.side = hand.side;
  hypothesis.model = assessment.model;
  hypothesis.phase = std::clamp(assessment.phase, 0.0, 1.0);
  hypothesis.end_probability = std::clamp(assessment.end_probability, 0.0, 1.0);
  if (assessment.context) {
    const Area& area = *assessment.context;
    hypothesis.context = scene::ContextArea{area.centre_m * px_per_m, area.radius_m * px_per_m,
                                            area.start_rad, area.end_rad};
  }
  hypothesis.candidates = Candidates(assessment);
  hypothesis.none_probability = std::clamp(assessment.none_probability, 0.0, 1.0);
  return hypothesis;
}

std::vector<scene::Candidate> PointingRecogniser::Candidates(const Assessment& assessment) const {
  std::vector<scene::Candidate> candidates;
  for (std::size_t i = 0; i < assessment.target_probability.size(); ++i) {
    const double probability = std::clamp(assessment.target_probability[i], 0.0, 1.0);
    if (probability < kLeastCandidate) continue;
    candidates.push_back(
        {surroundings_.targets[i].id, surroundings_.targets[i].label, probability});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.probability > b.probability; });
  return candidates;
}

scene::Gesture PointingRecogniser::Begin(const scene::Hand& hand, Timestamp now,
                                         const Assessment& assessment) {
  const Decision& decision = *assessment.decision;
  scene::Gesture gesture;
  gesture.time = now;
  gesture.event_id = ++events_;
  gesture.person_id = hand.person_id;
  gesture.hand_id = hand.id;
  gesture.side = hand.side;
  gesture.name = "pointing";
  gesture.start = Before(now, decision.started_s);
  gesture.outcome = decision.outcome;
  if (decision.outcome == scene::GestureOutcome::kObject) {
    const Target& target = surroundings_.targets[static_cast<std::size_t>(decision.target)];
    gesture.object_id = target.id;
    gesture.object_label = target.label;
  }
  gesture.candidates = Candidates(assessment);
  return gesture;
}

/// Reports the open gesture once more, with its end.
void PointingRecogniser::End(TrackedHand& track, Timestamp now, Recognition& result) const {
  if (!track.open) return;
  track.open->end = now;
  result.gestures.push_back(*track.open);
  track.open.reset();
}

}  // namespace deixis::gesture_recogniser
