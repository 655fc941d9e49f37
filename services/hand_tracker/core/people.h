#pragma once
#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "common/scene/object.h"
#include "common/time/timestamp.h"

namespace deixis::hand_tracker {

/// Somebody whose face was seen: the measure of everything else. Full image pixels.
struct Person {
  int key = -1;        ///< Stays the same for as long as the person is remembered.
  int person_id = -1;  ///< As given with the face; -1 = none was given.
  scene::Box face;     ///< Smoothed.
  Timestamp last_seen;
  int times_seen = 0;
  int images = 0;           ///< Since it was first seen.
  double liveliness = 0.0;  ///< Recent share of images in which the face moved a little.
};

/// Wrist crease to fingertip, about as long as a face detector's box is high (0.108 of the stature
/// in ANSUR II against about 0.115).
inline double HandLength(const Person& person) { return person.face.height_px; }

/// Where the shoulders lie below a face turned to the camera: the person's right one, then the
/// left.
std::array<Eigen::Vector2d, 2> Shoulders(const Person& person);

/// Distance of a point from the face in hand lengths.
double DistanceFromFace(const Person& person, const Eigen::Vector2d& point);

/// Whether a point lies on face or neck, where a hand cannot be told by its colour.
bool IsOnFace(const Person& person, const Eigen::Vector2d& point);

/// Remembers the people whose faces were seen lately, whether the news of them comes in time or
/// late.
class People {
 public:
  explicit People(double memory_s) : memory_s_(memory_s) {}

  void Update(const scene::Objects& objects);
  /// Forgets whoever was not seen for too long before `now`.
  void Forget(Timestamp now);
  void Reset() { people_.clear(); }

  /// Asks of every face whether something moves inside its box, `elapsed_s` after the last time.
  void NoteMotion(const std::function<bool(const scene::Box&)>& moves, double elapsed_s);

  /// Those seen several times and moving most of the time, as pictures on a wall do not; a face
  /// that flashes up once is nobody.
  std::vector<Person> established() const;

 private:
  void Update(const scene::Object& face, Timestamp time);
  Person* Find(const scene::Object& face, Timestamp time);

  double memory_s_;
  std::vector<Person> people_;
  int next_key_ = 0;
};

}  // namespace deixis::hand_tracker
