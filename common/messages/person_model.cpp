#include "common/messages/person_model.h"

#include <algorithm>
#include <deixis/body_model_t.hpp>
#include <optional>

#include "common/config/config.h"
#include "common/messages/geometry_parts.h"

namespace deixis::messages {
namespace {

using anthropometry::Sex;
using body_model::BodyModel;
using body_model::DegreeOfFreedom;
using body_model::DofKind;
using body_model::Limb;
using body_model::PersonModel;

DegreeOfFreedom ToDof(const dof_t& message) {
  DegreeOfFreedom dof;
  dof.name = Text(message.name);
  dof.kind = Enumeration(message.kind, DofKind::kTwist);
  dof.axis = ToVector<3>(message.axis);
  dof.angle_min_rad = Finite(message.angle_min_rad);
  dof.angle_max_rad = Finite(message.angle_max_rad);
  dof.speed_max_rad_per_s = Finite(message.speed_max_rad_per_s);
  dof.acceleration_max_rad_per_s2 = Finite(message.acceleration_max_rad_per_s2);
  return dof;
}

dof_t FromDof(const DegreeOfFreedom& dof) {
  dof_t message{};
  message.name = dof.name;
  message.kind = Number(dof.kind);
  FromVector(dof.axis, message.axis);
  message.angle_min_rad = Outgoing(dof.angle_min_rad);
  message.angle_max_rad = Outgoing(dof.angle_max_rad);
  message.speed_max_rad_per_s = Outgoing(dof.speed_max_rad_per_s);
  message.acceleration_max_rad_per_s2 = Outgoing(dof.acceleration_max_rad_per_s2);
  return message;
}

geometry::DegenerateCylinder ToShape(const limb_t& message) {
  return {Finite(message.a0_m),          Finite(message.b0_m),     Finite(message.a1_m),
          Finite(message.b1_m),          Finite(message.length_m), ToMetres<2>(message.centre0_m),
          ToMetres<2>(message.centre1_m)};
}

void FromShape(const geometry::DegenerateCylinder& shape, limb_t& message) {
  message.a0_m = Outgoing(shape.a0_m);
  message.b0_m = Outgoing(shape.b0_m);
  message.a1_m = Outgoing(shape.a1_m);
  message.b1_m = Outgoing(shape.b1_m);
  message.length_m = Outgoing(shape.length_m);
  FromVector(shape.centre0_m, message.centre0_m);
  FromVector(shape.centre1_m, message.centre1_m);
}

Limb ToLimb(const limb_t& message) {
  Limb limb;
  limb.name = Text(message.name);
  limb.parent = message.parent;
  limb.rest_in_parent = {ToRotationAsSent(message.rest_in_parent.rotation_wxyz),
                         ToMetres<3>(message.rest_in_parent.translation_m)};
  limb.shape = ToShape(message);
  for (const dof_t& dof : message.dofs) limb.dofs.push_back(ToDof(dof));
  for (const named_value_t& extra : message.extras) {
    Text(extra.name);
    Finite(extra.value);
  }
  return limb;
}

limb_t FromLimb(const BodyModel& body, int index) {
  const Limb& limb = body.limbs()[static_cast<std::size_t>(index)];
  limb_t message{};
  message.name = limb.name;
  message.parent = limb.parent;
  message.children.assign(body.children(index).begin(), body.children(index).end());
  message.n_children = static_cast<std::int32_t>(message.children.size());
  FromTransform(limb.rest_in_parent, message.rest_in_parent.translation_m,
                message.rest_in_parent.rotation_wxyz);
  FromShape(limb.shape, message);
  for (const DegreeOfFreedom& dof : limb.dofs) message.dofs.push_back(FromDof(dof));
  message.n_dofs = static_cast<std::int32_t>(message.dofs.size());
  return message;
}

void RequireChildren(const BodyModel& body, const body_model_t& message) {
  for (int i = 0; i < body.limb_count(); ++i) {
    const auto& said = message.limbs[static_cast<std::size_t>(i)].children;
    const auto& are = body.children(i);
    if (!std::equal(said.begin(), said.end(), are.begin(), are.end())) {
      throw Rejected("bad_children");
    }
  }
}

BodyModel ToBody(const body_model_t& message) {
  RequireCount(message.n_limbs, BodyModel::kMostLimbs);
  std::vector<Limb> limbs;
  for (const limb_t& limb : message.limbs) limbs.push_back(ToLimb(limb));
  try {
    BodyModel body(Text(message.name), std::move(limbs));
    RequireChildren(body, message);
    if (body.id() != message.model_id) throw Rejected("bad_model_id");
    return body;
  } catch (const config::ConfigError&) {
    throw Rejected("bad_body");
  }
}

std::optional<Sex> ToSex(std::int8_t number) {
  if (number == body_model_t::UNKNOWN) return std::nullopt;
  if (number == body_model_t::FEMALE) return Sex::kFemale;
  if (number == body_model_t::MALE) return Sex::kMale;
  throw Rejected("out_of_range");
}

std::int8_t FromSex(std::optional<Sex> sex) {
  if (!sex) return body_model_t::UNKNOWN;
  return *sex == Sex::kFemale ? body_model_t::FEMALE : body_model_t::MALE;
}

}  // namespace

Decoded<PersonModel> Codec<PersonModel>::Decode(Bytes bytes) {
  const auto message = DecodeWire<body_model_t>(bytes);
  PersonModel person{ToTimestamp(message.utime), ToBody(message)};
  person.person_id = AtLeast(-1, message.person_id);
  person.identity = Text(message.identity);
  person.sex = ToSex(message.sex);
  person.female_probability = Probability(message.female_probability);
  person.stature_m = NotNegative(message.stature_m, BodyModel::kLargest_m);
  person.stature_variance_m2 = NotNegative(message.stature_variance_m2, kFarthest_m * kFarthest_m);
  person.is_frozen = message.is_frozen != 0;
  return {std::move(person), Count(message.sequence)};
}

std::vector<std::uint8_t> Codec<PersonModel>::Encode(const PersonModel& person,
                                                     std::int64_t sequence) {
  body_model_t message{};
  message.utime = person.time.microseconds;
  message.sequence = sequence;
  message.model_id = person.body.id();
  message.name = person.body.name();
  message.person_id = person.person_id;
  message.identity = person.identity;
  message.sex = FromSex(person.sex);
  message.female_probability = Outgoing(person.female_probability);
  message.stature_m = Outgoing(person.stature_m);
  message.stature_variance_m2 = Outgoing(person.stature_variance_m2);
  message.is_frozen = person.is_frozen;
  for (int i = 0; i < person.body.limb_count(); ++i) {
    message.limbs.push_back(FromLimb(person.body, i));
  }
  message.n_limbs = static_cast<std::int32_t>(message.limbs.size());
  return EncodeWire(message);
}

}  // namespace deixis::messages
