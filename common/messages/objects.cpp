#include "common/messages/objects.h"

#include <algorithm>
#include <deixis/objects_t.hpp>
#include <optional>

#include "common/messages/scene_parts.h"

namespace deixis::messages {
namespace {

using scene::Object;
using scene::ObjectKind;
using scene::ObjectPosition;
using scene::Objects;
using scene::Visibility;

// Faces give the scale of the image.
void RequireVisible(const std::optional<scene::Box>& face) {
  if (face && std::min(face->width_px, face->height_px) < 1.0) throw Rejected("out_of_range");
}

Object ToObject(const object_t& message) {
  Object object;
  object.id = message.id;
  object.label = Text(message.label);
  object.kind = Enumeration(message.kind, ObjectKind::kPlace);
  object.person_id = message.person_id;
  if (message.has_box) object.box = ToBox(message.box_px);
  if (object.kind == ObjectKind::kFace) RequireVisible(object.box);
  if (message.has_position) {
    object.position = ObjectPosition{ToMetres<3>(message.position_m),
                                     ToCovariance<3>(message.position_covariance_m2, kFarthest_m),
                                     ToMetres<3>(message.extent_m)};
  }
  object.score = Probability(message.score);
  object.visibility = Enumeration(message.visibility, Visibility::kRemembered);
  object.last_seen = ToTimestamp(message.last_seen_utime);
  return object;
}

object_t FromObject(const Object& object) {
  object_t message{};
  message.id = object.id;
  message.label = object.label;
  message.kind = Number(object.kind);
  message.person_id = object.person_id;
  message.has_box = object.box.has_value();
  if (object.box) FromBox(*object.box, message.box_px);
  message.has_position = object.position.has_value();
  if (object.position) {
    FromVector(object.position->position_m, message.position_m);
    FromSymmetric(object.position->covariance_m2, message.position_covariance_m2);
    FromVector(object.position->extent_m, message.extent_m);
  }
  message.score = Outgoing(object.score);
  message.visibility = Number(object.visibility);
  message.last_seen_utime = object.last_seen.microseconds;
  return message;
}

}  // namespace

Decoded<Objects> Codec<Objects>::Decode(Bytes bytes) {
  const auto message = DecodeWire<objects_t>(bytes);
  RequireCount(message.n_objects, kMostObjects);
  Objects objects{ToTimestamp(message.utime),
                  Text(message.camera),
                  Text(message.frame),
                  Text(message.source),
                  {}};
  for (const object_t& object : message.objects) objects.objects.push_back(ToObject(object));
  return {std::move(objects), Count(message.sequence)};
}

std::vector<std::uint8_t> Codec<Objects>::Encode(const Objects& objects, std::int64_t sequence) {
  objects_t message{};
  message.utime = objects.time.microseconds;
  message.sequence = sequence;
  message.camera = objects.camera;
  message.frame = objects.frame;
  message.source = objects.source;
  for (const Object& object : objects.objects) message.objects.push_back(FromObject(object));
  message.n_objects = static_cast<std::int32_t>(message.objects.size());
  return EncodeWire(message);
}

}  // namespace deixis::messages
