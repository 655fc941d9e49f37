// Bodies and their poses, there and back.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>

#include "common/body_model/kinematics.h"
#include "common/messages/body_poses.h"
#include "common/messages/person_model.h"
#include "test/common/body_model/body_samples.h"
#include "test/common/body_model/tracked_samples.h"

namespace deixis::messages {
namespace {

using anthropometry::Sex;
using body_model::BodyModel;
using body_model::BodyPoses;
using body_model::Kinematics;
using body_model::kSampleTime;
using body_model::LimbState;
using body_model::Person;
using body_model::PersonModel;
using body_model::TrackedBody;

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

using Block = std::vector<std::uint8_t>;

template <typename T>
T Decode(const Block& bytes) {
  return Codec<T>::Decode({bytes.data(), bytes.size()}).value;
}

template <typename T>
T RoundTrip(const T& value) {
  const Block bytes = Codec<T>::Encode(value, 42);
  const auto [decoded, sequence] = Codec<T>::Decode({bytes.data(), bytes.size()});
  EXPECT_EQ(sequence, 42);
  EXPECT_EQ(Codec<T>::Time(decoded), kSampleTime);
  EXPECT_EQ(Codec<T>::Encode(decoded, 42), bytes);
  return decoded;
}

class ShippedBodies : public testing::TestWithParam<Person> {};

TEST_P(ShippedBodies, SurviveTheirOwnEncodingBitForBit) {
  for (const std::string& name : body_model::ShippedNames()) {
    const BodyModel model = Shipped(name, GetParam());
    const PersonModel decoded = RoundTrip(PersonOf(model));
    EXPECT_EQ(decoded.body.id(), model.id());
    EXPECT_EQ(decoded.body.name(), model.name());
    EXPECT_EQ(decoded.body.angle_count(), model.angle_count());
    for (int i = 0; i < model.limb_count(); ++i) {
      EXPECT_EQ(decoded.body.children(i), model.children(i)) << name;
    }
  }
}

TEST_P(ShippedBodies, HavePosesThatSurviveTheirOwnEncodingBitForBit) {
  std::mt19937 random(11);
  for (const std::string& name : body_model::ShippedNames()) {
    const BodyModel model = Shipped(name, GetParam());
    const TrackedBody body = BodyOf(model, random);
    const TrackedBody decoded = RoundTrip(PosesOf(body)).bodies.at(0);
    EXPECT_EQ(decoded.pose.angles_rad, body.pose.angles_rad) << name;
    EXPECT_EQ(decoded.rates_rad_per_s, body.rates_rad_per_s);
    EXPECT_EQ(decoded.covariance, body.covariance);
    EXPECT_EQ(decoded.pose.frame_from_root.rotation.coeffs(),
              body.pose.frame_from_root.rotation.coeffs());
    EXPECT_NO_THROW(CheckAgainst(decoded, model));
  }
}

TEST_P(ShippedBodies, TravelWithZerosForRatesThatAreNotKnown) {
  std::mt19937 random(13);
  const BodyModel model = Shipped("whole_body", GetParam());
  TrackedBody body = BodyOf(model, random);
  body.rates_rad_per_s = {};
  const TrackedBody decoded = RoundTrip(PosesOf(body)).bodies.at(0);
  ASSERT_EQ(decoded.rates_rad_per_s.size(), model.angle_count());
  EXPECT_TRUE(decoded.rates_rad_per_s.isZero(0.0));
}

TEST_P(ShippedBodies, TellWhereTheirLimbsAre) {
  std::mt19937 random(12);
  for (const std::string& name : body_model::ShippedNames()) {
    const BodyModel model =
        Decode<PersonModel>(Codec<PersonModel>::Encode(PersonOf(Shipped(name, GetParam())), 0))
            .body;
    const TrackedBody body =
        Decode<BodyPoses>(Codec<BodyPoses>::Encode(PosesOf(BodyOf(model, random)), 0)).bodies[0];
    Kinematics kinematics(model);
    kinematics.Update(body.pose);
    for (int i = 0; i < model.limb_count(); ++i) {
      const auto& limb = body.limbs[static_cast<std::size_t>(i)];
      const Eigen::Vector3d tip_m(0.0, 0.05, 0.2);
      EXPECT_LE((limb.frame_from_limb * tip_m - kinematics.limb(i) * tip_m).norm(), 1e-12) << name;
      EXPECT_LE((limb.distal_m - kinematics.distal_m(i)).norm(), 1e-12) << name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(People, ShippedBodies, testing::ValuesIn(body_model::FourPeople()));

BodyModel Sample() { return {"sample", body_model::ArmAndHead()}; }

BodyPoses SamplePoses() {
  std::mt19937 random(13);
  return PosesOf(BodyOf(Sample(), random));
}

TEST(PersonMessage, CarriesWhatIsSaidBesideTheBody) {
  const PersonModel decoded = RoundTrip(PersonOf(Sample()));
  EXPECT_EQ(decoded.person_id, 3);
  EXPECT_EQ(decoded.identity, "badge 17");
  EXPECT_EQ(decoded.sex, Sex::kMale);
  EXPECT_EQ(decoded.female_probability, 0.25);
  EXPECT_EQ(decoded.stature_m, 1.8);
  EXPECT_EQ(decoded.stature_variance_m2, 0.0025);
  EXPECT_TRUE(decoded.is_frozen);
  EXPECT_EQ(RoundTrip(PersonModel{kSampleTime, Sample()}).sex, std::nullopt);
}

TEST(PersonMessage, CarriesLimitsOfSpeed) {
  auto limbs = body_model::ArmAndHead();
  limbs[2].dofs[0].speed_max_rad_per_s = 12.5;
  limbs[2].dofs[0].acceleration_max_rad_per_s2 = 300.0;
  const auto dof = RoundTrip(PersonModel{kSampleTime, {"sample", limbs}}).body.limbs()[2].dofs[0];
  EXPECT_EQ(dof.speed_max_rad_per_s, 12.5);
  EXPECT_EQ(dof.acceleration_max_rad_per_s2, 300.0);
}

TEST(PosesMessage, CarriesWhatIsSaidOfLimbsAndFloor) {
  const BodyPoses poses = SamplePoses();
  const BodyPoses decoded = RoundTrip(poses);
  EXPECT_EQ(decoded.camera, "STEREO");
  EXPECT_EQ(decoded.frame, "camera");
  EXPECT_EQ(decoded.source, "pose_fitter");
  EXPECT_EQ(decoded.floor->normal, Eigen::Vector3d(0.0, -0.8, -0.6));
  EXPECT_EQ(decoded.floor->offset_m, 1.4);
  const TrackedBody& body = decoded.bodies.at(0);
  EXPECT_EQ(body.state, body_model::BodyState::kTracked);
  EXPECT_EQ(body.identity, "badge 17");
  EXPECT_EQ(body.root_velocity_m_per_s, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(body.root_rate_rad_per_s, Eigen::Vector3d(-0.1, -0.2, -0.3));
  EXPECT_EQ(body.limbs[0].state, LimbState::kMeasured);
  EXPECT_EQ(body.limbs[0].residual_m, 0.012);
  EXPECT_EQ(body.limbs[0].inlier_count, 345);
  EXPECT_EQ(body.limbs[1].residual_m, -1.0);
  EXPECT_EQ(body.limbs[3].distal_covariance_m2, poses.bodies[0].limbs[3].distal_covariance_m2);
}

TEST(PosesMessage, MayHaveNobodyNoFloorAndNoCovariance) {
  EXPECT_TRUE(RoundTrip(BodyPoses{kSampleTime, "C", "", "", {}, {}}).bodies.empty());
  BodyPoses poses = SamplePoses();
  poses.floor.reset();
  poses.bodies[0].covariance.resize(0, 0);
  const BodyPoses decoded = RoundTrip(poses);
  EXPECT_FALSE(decoded.floor);
  EXPECT_EQ(decoded.bodies[0].covariance.size(), 0);
}

TEST(PosesMessage, IsRefusedWithAModelThatIsNotItsOwn) {
  const auto reason = [](TrackedBody body, const std::function<void(TrackedBody&)>& change) {
    change(body);
    try {
      CheckAgainst(body, Sample());
    } catch (const Rejected& rejected) {
      return std::string(rejected.what());
    }
    return std::string("accepted");
  };
  const TrackedBody body = SamplePoses().bodies[0];
  EXPECT_EQ(reason(body, [](auto&) {}), "accepted");
  EXPECT_EQ(reason(body, [](auto& it) { ++it.model_id; }), "other_model");
  EXPECT_EQ(reason(body, [](auto& it) { it.pose.angles_rad.conservativeResize(6); }),
            "bad_angle_count");
  EXPECT_EQ(reason(body, [](auto& it) { it.limbs.pop_back(); }), "bad_limb_count");
}

TEST(PosesMessage, DoesNotGoOutWithNumbersThatNobodyTakes) {
  for (const auto& change : std::vector<std::function<void(TrackedBody&)>>{
           [](auto& body) { body.pose.angles_rad[2] = kNan; },
           [](auto& body) { body.rates_rad_per_s[2] = kInfinity; },
           [](auto& body) { body.rates_rad_per_s.conservativeResize(2); },
           [](auto& body) { body.covariance(4, 2) = kNan; },
           [](auto& body) { body.covariance(4, 2) = 1e200; },  // No number in single precision.
           [](auto& body) { body.covariance.conservativeResize(8, 8); },
           [](auto& body) { body.limbs[1].proximal_m.x() = kNan; },
           [](auto& body) { body.root_velocity_m_per_s.z() = kNan; }}) {
    BodyPoses poses = SamplePoses();
    change(poses.bodies[0]);
    EXPECT_THROW(Codec<BodyPoses>::Encode(poses, 0), std::logic_error);
  }
}

}  // namespace
}  // namespace deixis::messages
