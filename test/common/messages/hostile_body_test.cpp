// Bodies and their poses, broken one way per row.
#include <gmock/gmock.h>

#include <deixis/body_model_t.hpp>
#include <deixis/body_poses_t.hpp>
#include <functional>
#include <limits>

#include "common/messages/body_poses.h"
#include "common/messages/person_model.h"
#include "test/common/body_model/body_samples.h"
#include "test/common/body_model/tracked_samples.h"

namespace deixis::messages {
namespace {

using body_model::BodyModel;
using body_model::BodyPoses;
using body_model::PersonModel;

using Block = std::vector<std::uint8_t>;

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

BodyModel Sample() { return {"sample", body_model::ArmAndHead()}; }

BodyPoses SamplePoses() {
  std::mt19937 random(13);
  return PosesOf(BodyOf(Sample(), random));
}

/// One way to break a message, and the reason why it is refused.
template <typename Message>
struct Fault {
  std::string reason;
  std::function<void(Message&)> break_it;
};

template <typename Message>
Block Encoded(const Message& message) {
  Block bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

template <typename Message, typename T>
std::string ReasonOf(const T& good, const std::function<void(Message&)>& break_it) {
  const Block bytes = Codec<T>::Encode(good, 7);
  Message message{};
  message.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
  break_it(message);
  try {
    const Block broken = Encoded(message);
    Codec<T>::Decode({broken.data(), broken.size()});
  } catch (const Rejected& rejected) {
    return rejected.what();
  }
  return "accepted";
}

template <typename Message, typename T>
void ExpectRefused(const T& good, const std::vector<Fault<Message>>& faults) {
  EXPECT_EQ(ReasonOf<Message>(good, [](Message&) {}), "accepted");
  for (std::size_t i = 0; i < faults.size(); ++i) {
    EXPECT_EQ(ReasonOf<Message>(good, faults[i].break_it), faults[i].reason) << "row " << i;
  }
}

TEST(HostilePerson, IsRefusedForWhatIsSaidOfThePerson) {
  ExpectRefused<body_model_t>(PersonOf(Sample()),
                              {{"out_of_range", [](auto& it) { it.utime = -1; }},
                               {"out_of_range", [](auto& it) { it.sequence = -1; }},
                               {"out_of_range", [](auto& it) { it.person_id = -2; }},
                               {"text_too_long", [](auto& it) { it.identity.assign(1025, 'a'); }},
                               {"bad_string", [](auto& it) { it.identity = "\xFF"; }},
                               {"out_of_range", [](auto& it) { it.sex = 3; }},
                               {"out_of_range", [](auto& it) { it.sex = -1; }},
                               {"out_of_range", [](auto& it) { it.female_probability = 1.1; }},
                               {"not_finite", [](auto& it) { it.female_probability = kNan; }},
                               {"out_of_range", [](auto& it) { it.stature_m = -0.1; }},
                               {"out_of_range", [](auto& it) { it.stature_m = 3.1; }},
                               {"not_finite", [](auto& it) { it.stature_m = kInfinity; }},
                               {"out_of_range", [](auto& it) { it.stature_variance_m2 = -1e-9; }},
                               {"not_finite", [](auto& it) { it.stature_variance_m2 = kNan; }},
                               {"bad_boolean", [](auto& it) { it.is_frozen = 2; }}});
}

// What is well-formed but other than the model that the id names is no less a fault.
TEST(HostilePerson, IsRefusedWhenItsIdIsNotThatOfItsContent) {
  ExpectRefused<body_model_t>(
      PersonOf(Sample()),
      {{"bad_model_id", [](auto& it) { it.model_id = 0; }},
       {"bad_model_id", [](auto& it) { ++it.model_id; }},
       {"bad_model_id", [](auto& it) { it.name += "x"; }},
       {"bad_model_id", [](auto& it) { it.limbs[2].name += "x"; }},
       {"bad_model_id", [](auto& it) { it.limbs[2].a0_m += 1e-16; }},
       {"bad_model_id", [](auto& it) { it.limbs[2].b0_m += 1e-16; }},
       {"bad_model_id", [](auto& it) { it.limbs[2].a1_m += 1e-16; }},
       {"bad_model_id", [](auto& it) { it.limbs[2].b1_m += 1e-16; }},
       {"bad_model_id", [](auto& it) { it.limbs[2].length_m += 1e-15; }},
       {"bad_model_id", [](auto& it) { it.limbs[2].centre0_m[1] += 1e-15; }},
       {"bad_model_id", [](auto& it) { it.limbs[2].centre1_m[0] += 1e-15; }},
       {"bad_model_id", [](auto& it) { it.limbs[1].rest_in_parent.translation_m[0] += 1e-15; }},
       {"bad_model_id", [](auto& it) { it.limbs[1].rest_in_parent.rotation_wxyz[0] += 1e-15; }},
       {"bad_model_id", [](auto& it) { it.limbs[1].dofs[0].name += "x"; }},
       {"bad_model_id", [](auto& it) { it.limbs[1].dofs[0].angle_min_rad -= 1e-15; }},
       {"bad_model_id", [](auto& it) { it.limbs[1].dofs[0].angle_max_rad += 1e-15; }},
       {"bad_model_id", [](auto& it) { it.limbs[1].dofs[0].speed_max_rad_per_s = 1.0; }},
       {"bad_model_id", [](auto& it) { it.limbs[1].dofs[0].acceleration_max_rad_per_s2 = 1.0; }},
       {"bad_model_id", [](auto& it) { std::swap(it.limbs[1].dofs[0], it.limbs[1].dofs[1]); }}});
}

TEST(HostilePerson, IsRefusedForLimbsThatAreNoBody) {
  ExpectRefused<body_model_t>(
      PersonOf(Sample()),
      {{"bad_body",
        [](auto& it) {
          it.limbs.clear();
          it.n_limbs = 0;
        }},
       {"too_many",
        [](auto& it) {
          it.limbs.resize(1001, it.limbs[0]);
          it.n_limbs = 1001;
        }},
       {"bad_body", [](auto& it) { it.limbs[0].parent = 0; }},
       {"bad_body", [](auto& it) { it.limbs[2].parent = 2; }},
       {"bad_body", [](auto& it) { it.limbs[2].parent = -2; }},
       {"bad_body", [](auto& it) { it.limbs[2].name = it.limbs[1].name; }},
       {"bad_body", [](auto& it) { it.limbs[2].name = ""; }},
       {"text_too_long", [](auto& it) { it.limbs[2].name.assign(1025, 'a'); }},
       {"text_too_long", [](auto& it) { it.name.assign(1025, 'a'); }},
       {"bad_children", [](auto& it) { it.limbs[0].children[0] = 2; }},
       {"bad_children",
        [](auto& it) {
          it.limbs[0].children.pop_back();
          --it.limbs[0].n_children;
        }},
       {"not_finite", [](auto& it) { it.limbs[2].a0_m = kNan; }},
       {"not_finite", [](auto& it) { it.limbs[2].b0_m = kInfinity; }},
       {"bad_body", [](auto& it) { it.limbs[2].a1_m = 0.0; }},
       {"bad_body", [](auto& it) { it.limbs[2].b1_m = -0.1; }},
       {"bad_body", [](auto& it) { it.limbs[2].length_m = 3.1; }},
       {"not_finite", [](auto& it) { it.limbs[2].centre0_m[0] = kNan; }},
       {"bad_body", [](auto& it) { it.limbs[2].centre1_m[1] = 3.1; }},
       {"bad_body", [](auto& it) { it.limbs[2].rest_in_parent.translation_m[1] = 3.1; }},
       {"not_finite", [](auto& it) { it.limbs[2].rest_in_parent.translation_m[1] = kNan; }},
       {"not_a_rotation", [](auto& it) { it.limbs[2].rest_in_parent.rotation_wxyz[0] = 0.0; }},
       {"bad_body", [](auto& it) { it.limbs[2].rest_in_parent.rotation_wxyz[0] = 1.0001; }},
       {"not_finite", [](auto& it) { it.limbs[2].rest_in_parent.rotation_wxyz[1] = kNan; }},
       {"not_finite", [](auto& it) {
          it.limbs[2].extras.assign(1, named_value_t{});
          it.limbs[2].extras[0].value = kNan;
          it.limbs[2].n_extras = 1;
        }}});
}

TEST(HostilePerson, IsRefusedForAnglesThatAreNone) {
  ExpectRefused<body_model_t>(
      PersonOf(Sample()),
      {{"out_of_range", [](auto& it) { it.limbs[1].dofs[0].kind = 3; }},
       {"bad_body", [](auto& it) { it.limbs[1].dofs[0].kind = dof_t::HINGE; }},
       {"bad_body", [](auto& it) { it.limbs[1].dofs[0].name = ""; }},
       {"bad_string", [](auto& it) { it.limbs[1].dofs[0].name = "\xFF"; }},
       {"bad_body", [](auto& it) { it.limbs[1].dofs[0].axis[0] = 0.5; }},
       {"not_finite", [](auto& it) { it.limbs[1].dofs[0].axis[0] = kNan; }},
       {"bad_body", [](auto& it) { it.limbs[1].dofs[0].angle_min_rad = 3.0; }},
       {"bad_body", [](auto& it) { it.limbs[1].dofs[0].angle_max_rad = 7.0; }},
       {"not_finite", [](auto& it) { it.limbs[1].dofs[0].angle_max_rad = kNan; }},
       {"bad_body", [](auto& it) { it.limbs[1].dofs[0].speed_max_rad_per_s = -1.0; }},
       {"not_finite", [](auto& it) { it.limbs[1].dofs[0].speed_max_rad_per_s = kInfinity; }},
       {"bad_body", [](auto& it) { it.limbs[1].dofs[0].acceleration_max_rad_per_s2 = -1.0; }},
       {"not_finite", [](auto& it) { it.limbs[1].dofs[0].acceleration_max_rad_per_s2 = kNan; }},
       {"bad_body", [](auto& it) {
          it.limbs[1].dofs.resize(4, it.limbs[1].dofs[0]);
          it.limbs[1].n_dofs = 4;
        }}});
}

TEST(HostilePoses, AreRefusedForWhatIsSaidOfTheImage) {
  ExpectRefused<body_poses_t>(SamplePoses(),
                              {{"out_of_range", [](auto& it) { it.utime = -1; }},
                               {"out_of_range", [](auto& it) { it.sequence = -1; }},
                               {"text_too_long", [](auto& it) { it.camera.assign(1025, 'a'); }},
                               {"text_too_long", [](auto& it) { it.frame.assign(1025, 'a'); }},
                               {"bad_string", [](auto& it) { it.source = "\xFF"; }},
                               {"bad_boolean", [](auto& it) { it.has_floor = 2; }},
                               {"not_a_plane", [](auto& it) { it.floor_plane[1] = 0.0; }},
                               {"not_finite", [](auto& it) { it.floor_plane[3] = kNan; }},
                               {"bad_order",
                                [](auto& it) {
                                  it.bodies.push_back(it.bodies[0]);
                                  it.n_bodies = 2;
                                }},
                               {"too_many", [](auto& it) {
                                  it.bodies.resize(257, it.bodies[0]);
                                  it.n_bodies = 257;
                                }}});
}

TEST(HostilePoses, AreRefusedForWhatIsSaidOfAPerson) {
  ExpectRefused<body_poses_t>(
      SamplePoses(),
      {{"out_of_range", [](auto& it) { it.bodies[0].person_id = -1; }},
       {"text_too_long", [](auto& it) { it.bodies[0].identity.assign(1025, 'a'); }},
       {"bad_model_id", [](auto& it) { it.bodies[0].model_id = 0; }},
       {"out_of_range", [](auto& it) { it.bodies[0].state = 3; }},
       {"out_of_range", [](auto& it) { it.bodies[0].state = -1; }},
       {"not_finite", [](auto& it) { it.bodies[0].root_in_frame.translation_m[0] = kNan; }},
       {"not_a_rotation", [](auto& it) { it.bodies[0].root_in_frame.rotation_wxyz[0] = 2.0; }},
       {"not_finite", [](auto& it) { it.bodies[0].root_velocity[5] = kInfinity; }},
       {"not_finite", [](auto& it) { it.bodies[0].angles_rad[6] = kNan; }},
       {"out_of_range", [](auto& it) { it.bodies[0].angles_rad[6] = 1e3; }},
       {"not_finite", [](auto& it) { it.bodies[0].rates_rad_per_s[6] = kNan; }},
       {"too_many",
        [](auto& it) {
          it.bodies[0].n_angles = 3001;
          it.bodies[0].angles_rad.resize(3001);
          it.bodies[0].rates_rad_per_s.resize(3001);
        }},
       {"bad_covariance_size",
        [](auto& it) {
          it.bodies[0].covariance.pop_back();
          --it.bodies[0].n_covariance;
        }},
       {"not_finite",
        [](auto& it) { it.bodies[0].covariance[7] = std::numeric_limits<float>::quiet_NaN(); }},
       {"out_of_range", [](auto& it) { it.bodies[0].covariance[7] = 1e30F; }},
       {"out_of_range", [](auto& it) { it.bodies[0].covariance[0] = -1e-9F; }},
       {"out_of_range", [](auto& it) { it.bodies[0].covariance.back() = -1e-9F; }}});
}

TEST(HostilePoses, AreRefusedForWhatIsSaidOfALimb) {
  ExpectRefused<body_poses_t>(
      SamplePoses(),
      {{"too_many",
        [](auto& it) {
          it.bodies[0].limbs.resize(1001, it.bodies[0].limbs[0]);
          it.bodies[0].n_limbs = 1001;
        }},
       {"not_a_rotation", [](auto& it) { it.bodies[0].limbs[4].in_parent.rotation_wxyz[0] = 2.0; }},
       {"not_finite", [](auto& it) { it.bodies[0].limbs[4].in_parent.translation_m[2] = kNan; }},
       {"not_a_rotation", [](auto& it) { it.bodies[0].limbs[4].in_frame.rotation_wxyz[0] = 2.0; }},
       {"out_of_range", [](auto& it) { it.bodies[0].limbs[4].in_frame.translation_m[2] = 1e7; }},
       {"not_finite", [](auto& it) { it.bodies[0].limbs[4].proximal_m[0] = kNan; }},
       {"out_of_range", [](auto& it) { it.bodies[0].limbs[4].proximal_covariance_m2[2] = -1.0; }},
       {"not_finite", [](auto& it) { it.bodies[0].limbs[4].distal_m[0] = kNan; }},
       {"not_finite", [](auto& it) { it.bodies[0].limbs[4].distal_covariance_m2[1] = kNan; }},
       {"out_of_range", [](auto& it) { it.bodies[0].limbs[4].state = 4; }},
       {"out_of_range", [](auto& it) { it.bodies[0].limbs[4].residual_m = -0.5; }},
       {"not_finite", [](auto& it) { it.bodies[0].limbs[4].residual_m = kNan; }},
       {"out_of_range", [](auto& it) { it.bodies[0].limbs[4].n_inliers = -1; }}});
}

template <typename T>
void ExpectTruncationsRefused(const Block& whole) {
  for (std::size_t size = 0; size < whole.size(); ++size) {
    try {
      Codec<T>::Decode({whole.data(), size});
      ADD_FAILURE() << size << " bytes are accepted";
    } catch (const Rejected& rejected) {
      EXPECT_STREQ(rejected.what(), "truncated") << size;
    }
  }
}

TEST(HostilePerson, IsRefusedWhereverItIsCutOff) {
  ExpectTruncationsRefused<PersonModel>(Codec<PersonModel>::Encode(PersonOf(Sample()), 0));
}

TEST(HostilePoses, AreRefusedWhereverTheyAreCutOff) {
  ExpectTruncationsRefused<BodyPoses>(Codec<BodyPoses>::Encode(SamplePoses(), 0));
}

}  // namespace
}  // namespace deixis::messages
