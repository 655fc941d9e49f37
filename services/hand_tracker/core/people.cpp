#include "services/hand_tracker/core/people.h"

#include <algorithm>
#include <cmath>

namespace deixis::hand_tracker {
namespace {

// Proportions in face boxes, from shares of the stature: box 0.1045, shoulder 0.102 out and 0.118
// below the face's centre, upper arm 0.1455, forearm 0.139, wrist to the hand's centre 0.045.
constexpr double kShoulderOut = 0.88;
constexpr double kShoulderDown = 1.03;
// A detector errs now and then: a face must be seen several times, and is remembered for the longer
// the more often it was.
constexpr int kLeastSights = 2;
constexpr double kLeastLiveliness = 0.25;
constexpr double kTrustPerSight_s = 0.4;

std::array<Eigen::Vector2d, 2> Pair(const Person& person, double out, double down) {
  const Eigen::Vector2d face = scene::Centre(person.face);
  const double unit = HandLength(person);
  return {face + unit * Eigen::Vector2d(-out, down), face + unit * Eigen::Vector2d(out, down)};
}

scene::Box Blend(const scene::Box& from, const scene::Box& to, double share) {
  const auto mix = [share](double a, double b) { return a + share * (b - a); };
  return {mix(from.x_px, to.x_px), mix(from.y_px, to.y_px), mix(from.width_px, to.width_px),
          mix(from.height_px, to.height_px)};
}

bool IsUsable(const scene::Object& object) {
  return object.kind == scene::ObjectKind::kFace && object.box && object.box->width_px > 0.0 &&
         object.box->height_px > 0.0 && object.visibility == scene::Visibility::kSeen;
}

bool CouldHaveMovedTo(const Person& person, const scene::Box& box, Timestamp time) {
  constexpr double kFarthest = 1.5;  // In hand lengths ...
  constexpr double kSpeed = 2.0;     // ... and per second.
  constexpr double kSizeRatio = 1.5;
  const double away_s = SecondsBetween(person.last_seen, time);
  const double distance = DistanceFromFace(person, scene::Centre(box));
  const double ratio = box.height_px / person.face.height_px;
  return away_s > 0.0 && distance < std::min(kFarthest, 0.5 + kSpeed * away_s) &&
         ratio < kSizeRatio && ratio > 1.0 / kSizeRatio;
}

}  // namespace

std::array<Eigen::Vector2d, 2> Shoulders(const Person& person) {
  return Pair(person, kShoulderOut, kShoulderDown);
}

double DistanceFromFace(const Person& person, const Eigen::Vector2d& point) {
  return (point - scene::Centre(person.face)).norm() / HandLength(person);
}

bool IsOnFace(const Person& person, const Eigen::Vector2d& point) {
  const Eigen::Vector2d offset = (point - scene::Centre(person.face)) / HandLength(person);
  const bool is_on_head = offset.cwiseQuotient(Eigen::Vector2d(0.6, 0.8)).squaredNorm() < 1.0;
  const bool is_on_neck = std::abs(offset.x()) < 0.4 && offset.y() > 0.0 && offset.y() < 1.05;
  return is_on_head || is_on_neck;
}

void People::Update(const scene::Objects& objects) {
  for (const scene::Object& object : objects.objects) {
    if (IsUsable(object)) Update(object, objects.time);
  }
}

void People::Update(const scene::Object& face, Timestamp time) {
  constexpr double kFollow = 0.5;       // Of a new box's place ...
  constexpr double kFollowSize = 0.15;  // ... and of its size, which detectors know less well.
  Person* person = Find(face, time);
  if (person == nullptr) {
    people_.push_back({next_key_++, face.person_id, *face.box, time, 1, 0, 0.0});
    return;
  }
  const Eigen::Vector2d centre = scene::Centre(Blend(person->face, *face.box, kFollow));
  const scene::Box size = Blend(person->face, *face.box, kFollowSize);
  person->face = {centre.x() - 0.5 * size.width_px, centre.y() - 0.5 * size.height_px,
                  size.width_px, size.height_px};
  person->person_id = face.person_id;
  person->last_seen = time;
  ++person->times_seen;
}

/// The person whose face this is: the same id, the largest overlap, or whoever was out of sight and
/// could have moved here since.
Person* People::Find(const scene::Object& face, Timestamp time) {
  constexpr double kLeastOverlap = 0.25;
  Person* best = nullptr;
  double best_overlap = kLeastOverlap;
  for (Person& person : people_) {
    if (face.person_id >= 0 && person.person_id == face.person_id) return &person;
    const double overlap = scene::Overlap(person.face, *face.box);
    if (overlap > best_overlap) {
      best = &person;
      best_overlap = overlap;
    }
  }
  if (best != nullptr) return best;
  const auto moved = std::find_if(people_.begin(), people_.end(), [&](const Person& person) {
    return CouldHaveMovedTo(person, *face.box, time);
  });
  return moved == people_.end() ? nullptr : &*moved;
}

void People::NoteMotion(const std::function<bool(const scene::Box&)>& moves, double elapsed_s) {
  constexpr double kTime_s = 2.0;
  const double usual_share = 1.0 - std::exp(-elapsed_s / kTime_s);
  for (Person& person : people_) {
    const double share = std::max(usual_share, 1.0 / ++person.images);  // A plain mean at first.
    person.liveliness += share * ((moves(person.face) ? 1.0 : 0.0) - person.liveliness);
  }
}

void People::Forget(Timestamp now) {
  people_.erase(std::remove_if(people_.begin(), people_.end(),
                               [&](const Person& person) {
                                 const double trust_s = kTrustPerSight_s * person.times_seen;
                                 // The absolute value: time may have jumped back.
                                 return std::abs(SecondsBetween(person.last_seen, now)) >
                                        std::min(memory_s_, trust_s);
                               }),
                people_.end());
}

std::vector<Person> People::established() const {
  std::vector<Person> established;
  for (const Person& person : people_) {
    if (person.times_seen >= kLeastSights && person.liveliness > kLeastLiveliness)
      established.push_back(person);
  }
  return established;
}

}  // namespace deixis::hand_tracker
