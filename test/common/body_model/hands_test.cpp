// Hands of five fingers are added to a body by YAML alone. Their lengths are made up: measures of
// fingers other than mfl and dlf have no source here.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

#include "common/anthropometry/person_estimate.h"
#include "common/body_model/body_plan.h"
#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"
#include "test/common/body_model/body_samples.h"
#include "test/support/temporary_folder.h"

namespace deixis::body_model {
namespace {

using anthropometry::Populations;
using anthropometry::Sex;
using Eigen::Vector3d;

const std::string kConfig = DEIXIS_SOURCE_DIR "/config/";

/// Lengths as shares of the hand's (hdl); its frame has x to the thumb and z to the fingertips.
struct Finger {
  std::string name;
  double across;  ///< Of its first joint.
  double along;
  Vector3d direction;  ///< At zero angles.
  double lengths[3];
};

const Finger kFingers[]{{"thumb", 0.15, 0.12, {0.6, 0.0, 0.8}, {0.24, 0.17, 0.13}},
                        {"index_finger", 0.15, 0.56, {0.0, 0.0, 1.0}, {0.21, 0.12, 0.09}},
                        {"middle_finger", 0.05, 0.56, {0.0, 0.0, 1.0}, {0.23, 0.14, 0.10}},
                        {"ring_finger", -0.05, 0.54, {0.0, 0.0, 1.0}, {0.21, 0.13, 0.09}},
                        {"little_finger", -0.15, 0.51, {0.0, 0.0, 1.0}, {0.16, 0.10, 0.08}}};
const std::string kParts[]{"_first", "_second", "_third"};

std::string OfHand(double share) { return "[{of: hdl, share: " + std::to_string(share) + "}]"; }

/// The joint of a finger's first limb bends and spreads, the others are hinges. Palmar is -y.
std::string LimbText(const Finger& finger, int part) {
  const std::string name = finger.name + kParts[part];
  const std::string ellipse = "{a: " + OfHand(0.045) + ", b: " + OfHand(0.04) + "}";
  std::ostringstream text;
  text << "  - name: " << name << "\n    side: both\n";
  if (part == 0) {
    text << "    parent: hand\n    origin: {x: " << OfHand(finger.across)
         << ", z: " << OfHand(finger.along) << "}\n    rest_z: [" << finger.direction.x() << ", 0, "
         << finger.direction.z() << "]\n    rest_x: [" << finger.direction.z() << ", 0, "
         << -finger.direction.x() << "]\n";
  } else {
    text << "    parent: " << finger.name + kParts[part - 1]
         << "\n    origin: {z: " << OfHand(finger.lengths[part - 1])
         << "}\n    rest_z: [0, 0, 1]\n    rest_x: [1, 0, 0]\n";
  }
  text << "    length: " << OfHand(finger.lengths[part]) << "\n    proximal: " << ellipse
       << "\n    distal: " << ellipse
       << "\n    angles:\n      - {name: flexion, kind: " << (part == 0 ? "swing" : "hinge")
       << ", axis: [1, 0, 0], min_deg: -20, max_deg: 100}\n";
  if (part == 0) {
    text << "      - {name: abduction, kind: swing, axis: [0, 1, 0], min_deg: -20, max_deg: 20}\n";
  }
  return text.str();
}

std::string DetailedText() {
  std::ifstream file(kConfig + "body_models/whole_body_detailed.yaml");
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string TextWithHands() {
  std::string text = DetailedText();
  for (const Finger& finger : kFingers) {
    for (const int part : {0, 1, 2}) text += LimbText(finger, part);
  }
  return text;
}

const Sizes& PersonSizes() {
  static const Sizes sizes =
      SizesOf(Populations::Load(kConfig + "kinematics/population.yaml"), Sex::kFemale, 1.68);
  return sizes;
}

BodyModel PersonOf(const std::string& text) {
  const test::TemporaryFolder folder;
  return Build(LoadBodyPlan(folder.Write("body.yaml", text)), PersonSizes());
}

const BodyModel& Person() {
  static const BodyModel model = PersonOf(TextWithHands());
  return model;
}

int LimbNamed(const std::string& name) { return Person().Find(name).value(); }

/// Standing, with every joint of the fingers bent by `angle_rad`.
BodyPose Bent(double angle_rad) {
  BodyPose pose = Standing(Person());
  for (const std::string side : {"right_", "left_"}) {
    for (const Finger& finger : kFingers) {
      for (const std::string& part : kParts) {
        pose.angles_rad[Person().first_angle(LimbNamed(side + finger.name + part))] = angle_rad;
      }
    }
  }
  return pose;
}

/// Where a fingertip is when the first limb points along `first`, the second along `second` ... in
/// the hand's frame.
Vector3d Tip_m(const Kinematics& kinematics, const std::string& side, const Finger& finger,
               const Vector3d& first, const Vector3d& second, const Vector3d& third) {
  const Vector3d in_hand = Vector3d(finger.across, 0.0, finger.along) + finger.lengths[0] * first +
                           finger.lengths[1] * second + finger.lengths[2] * third;
  return kinematics.limb(LimbNamed(side + "hand")) * (PersonSizes().at("hdl") * in_hand);
}

TEST(Hands, AreThirtyLimbsMoreWithoutCode) {
  const BodyModel detailed = PersonOf(DetailedText());
  EXPECT_EQ(detailed.limb_count(), 19);
  EXPECT_EQ(Person().limb_count(), 19 + 30);
  EXPECT_EQ(Person().angle_count(), detailed.angle_count() + 2 * 5 * 4);
}

TEST(Hands, HaveARightAndALeftOneOfEachFinger) {
  for (const std::string side : {"right_", "left_"}) {
    for (const Finger& finger : kFingers) {
      int parent = LimbNamed(side + "hand");
      for (const std::string& part : kParts) {
        const int limb = LimbNamed(side + finger.name + part);
        EXPECT_EQ(Person().limbs()[static_cast<std::size_t>(limb)].parent, parent);
        parent = limb;
      }
    }
    EXPECT_EQ(Person().children(LimbNamed(side + "hand")).size(), 5u);
  }
  EXPECT_FALSE(Person().Find("thumb_first"));
}

TEST(Hands, StretchTheirFingersAtRest) {
  Kinematics kinematics(Person());
  kinematics.Update(Bent(0.0));
  for (const std::string side : {"right_", "left_"}) {
    for (const Finger& finger : kFingers) {
      const Vector3d& z = finger.direction;
      const int tip = LimbNamed(side + finger.name + "_third");
      EXPECT_LE((kinematics.distal_m(tip) - Tip_m(kinematics, side, finger, z, z, z)).norm(), 1e-6)
          << side << finger.name;
    }
  }
}

TEST(Hands, CloseToAFistWhenEachJointIsBentByARightAngle) {
  Kinematics kinematics(Person());
  kinematics.Update(Bent(M_PI / 2));
  for (const std::string side : {"right_", "left_"}) {
    const Vector3d palmar(0.0, side == "right_" ? -1.0 : 1.0, 0.0);
    for (const Finger& finger : kFingers) {
      const Vector3d expected = Tip_m(kinematics, side, finger, palmar, -finger.direction, -palmar);
      const int tip = LimbNamed(side + finger.name + "_third");
      EXPECT_LE((kinematics.distal_m(tip) - expected).norm(), 1e-6) << side << finger.name;
    }
  }
}

TEST(Hands, BendTowardsTheBodyWhenTheArmsHang) {
  Kinematics kinematics(Person());
  kinematics.Update(Bent(0.0));
  const int right = LimbNamed("right_index_finger_first");
  const int left = LimbNamed("left_index_finger_first");
  const double right_y = kinematics.distal_m(right).y(), left_y = kinematics.distal_m(left).y();
  kinematics.Update(Bent(0.5));
  EXPECT_GT(kinematics.distal_m(right).y(), right_y + 0.01);
  EXPECT_LT(kinematics.distal_m(left).y(), left_y - 0.01);
}

TEST(Hands, HaveJacobiansThatAreDerivatives) {
  std::mt19937 random(9);
  ExpectDerivatives(Person(), RandomPose(Person(), random));
  ExpectDerivatives(Person(), Bent(M_PI / 2));
}

TEST(Hands, PointAFingerWhereItIsAsked) {
  BodyPose pose = Standing(Person());
  const Vector3d ahead(1.0, 0.1, -0.5);
  PointLimb(Person(), LimbNamed("right_index_finger_first"), ahead, pose);
  Kinematics kinematics(Person());
  kinematics.Update(pose);
  const Vector3d along = kinematics.limb(LimbNamed("right_index_finger_first")).linear().col(2);
  EXPECT_LE((along - ahead.normalized()).norm(), 1e-9);
}

TEST(Hands, GiveTheModelAnotherId) {
  EXPECT_NE(Person().id(), PersonOf(DetailedText()).id());
  EXPECT_EQ(Person().id(), PersonOf(TextWithHands()).id());
  std::string longer = TextWithHands();
  const std::string last = OfHand(0.08);
  longer.replace(longer.rfind("length: " + last), 8 + last.size(), "length: " + OfHand(0.081));
  EXPECT_NE(Person().id(), PersonOf(longer).id());
}

}  // namespace
}  // namespace deixis::body_model
