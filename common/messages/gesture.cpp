#include "common/messages/gesture.h"

#include <deixis/gesture_t.hpp>

#include "common/messages/scene_parts.h"

namespace deixis::messages {
namespace {

using scene::Gesture;
using scene::GestureOutcome;
using scene::PointingRay;
using scene::Side;

// A unit vector and its spread.
constexpr double kLongestDirection = 10.0;

PointingRay ToRay(const gesture_t& message) {
  return {Text(message.frame), ToMetres<3>(message.ray_origin_m),
          ToVector<3>(message.ray_direction, kLongestDirection),
          ToCovariance<3>(message.ray_origin_covariance_m2, kFarthest_m),
          ToCovariance<3>(message.ray_direction_covariance, kLongestDirection)};
}

void FromRay(const PointingRay& ray, gesture_t& message) {
  message.frame = ray.frame;
  FromVector(ray.origin_m, message.ray_origin_m);
  FromVector(ray.direction, message.ray_direction);
  FromSymmetric(ray.origin_covariance_m2, message.ray_origin_covariance_m2);
  FromSymmetric(ray.direction_covariance, message.ray_direction_covariance);
}

}  // namespace

Decoded<Gesture> Codec<Gesture>::Decode(Bytes bytes) {
  const auto message = DecodeWire<gesture_t>(bytes);
  Gesture gesture;
  gesture.time = ToTimestamp(message.utime);
  gesture.event_id = message.event_id;
  gesture.person_id = message.person_id;
  gesture.hand_id = message.hand_id;
  gesture.side = Enumeration(message.side, Side::kRight);
  gesture.name = Text(message.name);
  gesture.start = ToTimestamp(message.start_utime);
  gesture.end = ToTimestamp(message.end_utime);
  gesture.outcome = Enumeration(message.outcome, GestureOutcome::kAmbiguous);
  gesture.object_id = message.object_id;
  gesture.object_label = Text(message.object_label);
  gesture.candidates = ToCandidates(message.candidates);
  if (message.has_ray) gesture.ray = ToRay(message);
  return {std::move(gesture), Count(message.sequence)};
}

std::vector<std::uint8_t> Codec<Gesture>::Encode(const Gesture& gesture, std::int64_t sequence) {
  gesture_t message{};
  message.utime = gesture.time.microseconds;
  message.sequence = sequence;
  message.event_id = gesture.event_id;
  message.person_id = gesture.person_id;
  message.hand_id = gesture.hand_id;
  message.side = Number(gesture.side);
  message.name = gesture.name;
  message.start_utime = gesture.start.microseconds;
  message.end_utime = gesture.end.microseconds;
  message.outcome = Number(gesture.outcome);
  message.object_id = gesture.object_id;
  message.object_label = gesture.object_label;
  message.candidates = FromCandidates(gesture.candidates);
  message.n_candidates = static_cast<std::int32_t>(message.candidates.size());
  message.has_ray = gesture.ray.has_value();
  if (gesture.ray) FromRay(*gesture.ray, message);
  return EncodeWire(message);
}

}  // namespace deixis::messages
